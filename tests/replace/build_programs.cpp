// Builds the four programs as generated C++: rung_replace_programs FOLDER
#include <cstdio>
#include <string>

#include "rtlib/load/seal.h"
#include "tests/replace/programs.h"
#include "tests/support/cpp_program.h"

using namespace rung;

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  for (uint32_t i = 0; i < test::kPrograms; ++i) {
    SourceManager sources;
    const std::string name = test::kNames[i];
    const FileId file = sources.addBuffer(name + ".lad", test::ladderOf(static_cast<test::Variant>(i)));
    frontend::CompileOptions options;
    options.config = {{"period_us", std::to_string(test::kPeriodUs)}};
    const Result<std::string> object =
        test::buildCppProgram(*frontend::findDialect("nct"), sources, std::span(&file, 1), options);
    const std::string wrong =
        object.ok() ? runtime::writeProgram(std::string(argv[1]) + "/" + name + ".so", runtime::sealed(object.value()))
                    : object.error();
    if (wrong.empty()) continue;
    std::fprintf(stderr, "%s: %s\n", name.c_str(), wrong.c_str());
    return 1;
  }
  return 0;
}
