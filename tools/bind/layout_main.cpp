// rung-layout: reads a struct of a C or C++ header for rungc bind. HEADER STRUCT FOLDER [FLAG...], where FOLDER has a
// compile_commands.json or is "". The layout is printed as JSON to standard output, errors as a sentence to standard
// error.
#include <cstdio>

#include "codegen/clang/layout_json.h"
#include "codegen/clang/read_header.h"

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("rung-layout is a part of rungc bind: HEADER STRUCT FOLDER [FLAG...]\n", stderr);
    return 2;
  }
  const rung::codegen::HeaderOutcome read = rung::codegen::readHeader(
      {.header = argv[1], .name = argv[2], .buildFolder = argv[3], .flags = {argv + 4, argv + argc}});
  if (read.layout) return std::fputs(rung::codegen::toJson(*read.layout).c_str(), stdout) < 0 ? 3 : 0;
  std::fprintf(stderr, "rungc: %s\n", read.problem.c_str());
  return 1;
}
