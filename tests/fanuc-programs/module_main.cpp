// rung_fanuc_module FILE...: prints the module of a FANUC program as its front end makes it, without its places in the
// sources. It is the same for a program in each source form.
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "frontend/dialects/fanuc/fanuc.h"
#include "ir/support/diag_render.h"
#include "tests/support/without_places.h"

namespace {

using namespace rung;

std::string moduleOf(const std::vector<std::string>& names) {
  SourceManager sources;
  const Result<std::vector<FileId>> files = compiler::addFiles(sources, names, {});
  if (!files.ok()) throw std::runtime_error(files.error());
  Diagnostics diagnostics;
  const auto module = frontend::fanuc::kFanuc.compile(sources, files.value(), {}, diagnostics);
  if (module == nullptr) throw std::runtime_error(renderText(diagnostics, sources));
  return frontend::test::withoutPlaces(*module);
}

} // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::cerr << "usage: rung_fanuc_module FILE...\n";
    return 2;
  }
  std::cout << moduleOf({argv + 1, argv + argc});
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "rung_fanuc_module: " << problem.what() << '\n';
  return 1;
}
