// A program from text to drawings, and what is wrong with a drawing: the shapes alone are asked, not how they came
// about.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"
#include "tools/view/layout.h"
#include "tools/view/program.h"

namespace rung::view::test {

// A program without errors; a program with errors fails the test that asks for it.
struct Drawn {
  SourceManager sources;
  Diagnostics diagnostics;
  std::unique_ptr<ir::Module> module;
  std::vector<frontend::ladder::LadderFile> ladders; // as the drawings were read from them; none: of charts
  Program program;

  const frontend::ladder::Rung& rung(size_t figure) const { return ladders[0].rungs[figure]; }
};
// The name tells the dialect as it does for the compiler: "a.lad", "a.pmc".
std::unique_ptr<Drawn> draw(const std::string& name, const std::string& text);
// A program of files, in their order.
std::unique_ptr<Drawn> drawFiles(const std::vector<std::string>& paths);
// The drawing as the only rung of module MAIN of an NCT program.
std::unique_ptr<Drawn> drawRung(const std::string& drawing);

// The rungs of the drawing are those of the module: number, title and place; each is drawn once, in ascending order.
void expectSameNumbers(const Drawn& drawn);

// Each gives nothing when all is well.
std::string wrongTexts(const frontend::ladder::Rung& rung, const Picture& picture); // every element and operand once
std::string overlaps(const Picture& picture);                                       // of texts, boxes and symbols
std::string wrongWires(const frontend::ladder::Rung& rung, const Picture& picture); // what is joined, and nothing else
std::string outOfBounds(const Picture& picture);

} // namespace rung::view::test
