// What the fuzz targets of names share: any bytes as a program of one or several files. What the front end says of
// names and operands is sound, also with errors; what compiles has a cross reference, warnings of names and, a ladder,
// a page.
#pragma once
#include <string>
#include <string_view>

#include "ir/support/check.h"
#include "tests/fuzz/split_files.h"
#include "tools/report/cross_reference.h"
#include "tools/report/odd_names.h"
#include "tools/view/drawn_program.h"
#include "tools/view/html.h"

namespace rung::fuzz {

inline void checkAnalysis(const SourceManager& sources, const frontend::Analysis& analysis) {
  for (const frontend::NameUse& name : analysis.names()) {
    RUNG_CHECK(name.definition < analysis.definitions().size(), "a name has a definition");
    RUNG_CHECK(name.range.valid() && analysis.nameAt(name.range) != nullptr, "a name is found where it is");
    sources.text(name.range);
  }
  for (const frontend::OperandUse& operand : analysis.operands()) {
    RUNG_CHECK(operand.place.bits != 0 && !operand.place.space.empty(), "an operand that is noted names a place");
    RUNG_CHECK(operand.base == frontend::kNoDefinition || operand.base < analysis.definitions().size(),
               "its name has a definition");
    sources.text(operand.range);
  }
}

inline void nameBytes(const frontend::Dialect& dialect, std::string_view extension, char border,
                      const std::string& text) {
  SourceManager sources;
  Diagnostics diagnostics;
  std::vector<FileId> files;
  for (const auto& [name, content] : splitFiles(text, extension, border))
    files.push_back(sources.addBuffer(name, content));
  const auto program = dialect.check(sources, files, {}, diagnostics);
  checkAnalysis(sources, program->analysis());
  if (diagnostics.hasErrors()) return;
  const auto module = program->build();
  if (module == nullptr) return;
  const report::ModuleReference whole(*module, dialect.shownSpaces);
  const report::CrossReference& reference = whole.get();
  std::vector<report::Entry> entries = reference.all();
  report::markOdd(sources, program->analysis(), reference, entries);
  report::reportOddNames(sources, program->analysis(), reference, diagnostics);
  if (const auto drawn = view::drawnProgram(sources, files, dialect, {}, diagnostics)) view::renderHtml(*drawn);
}

} // namespace rung::fuzz
