// Programs beside what they become: NAME.plc with NAME.ir (the module's text) or NAME.diag (what the compiler says).
// RUNG_UPDATE=1 writes the expectations anew; a review reads the difference.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "ir/text/text.h"
#include "tests/unit/technol/program.h"

namespace rung::technol_test {
namespace {

const std::filesystem::path kFolder = "tests/golden/technol";

std::string readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(TechnolGolden, AllPrograms) {
  std::vector<std::filesystem::path> programs;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    if (entry.path().extension() == ".plc") programs.push_back(entry.path());
  std::sort(programs.begin(), programs.end());
  ASSERT_FALSE(programs.empty());
  for (const std::filesystem::path& program : programs) {
    const Compilation result = compile({readFile(program)});
    const std::string text = result.module ? ir::print(*result.module) : result.text();
    const std::filesystem::path expected =
        std::filesystem::path(program).replace_extension(result.module ? ".ir" : ".diag");
    if (std::getenv("RUNG_UPDATE") != nullptr) std::ofstream(expected, std::ios::binary) << text;
    EXPECT_EQ(readFile(expected), text) << expected;
  }
}

} // namespace
} // namespace rung::technol_test
