// The scenarios of programs with mistakes report what they expect and nothing else: one mistake, one report.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/unit/gsk/compile.h"

namespace rung::frontend::gsk::test {
namespace {

namespace fs = std::filesystem;

std::string readFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// What a scenario says: its programs, and "LINE CODE" of its expect_error and expect_warning.
struct Expectations {
  std::vector<File> programs;
  frontend::CompileOptions options;
  Codes codes;
  bool errors = false;
  bool everyLineGiven = true;
};

Expectations expectationsOf(const fs::path& path) {
  Expectations result;
  std::istringstream text(readFile(path));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word, first, second;
    words >> word;
    if (word == "program")
      while (words >> first)
        result.programs.push_back({(path.parent_path() / first).string(), readFile(path.parent_path() / first)});
    if (word == "config" && words >> first >> second) result.options.config[first] = second;
    if (word != "expect_error" && word != "expect_warning") continue;
    result.errors = result.errors || word == "expect_error";
    if (words >> first >> second)
      result.codes.push_back(first + " " + second);
    else
      result.everyLineGiven = false;
  }
  std::sort(result.codes.begin(), result.codes.end());
  return result;
}

TEST(GskErrorScenarios, DoubleCoils) {
  size_t count = 0;
  for (const auto& entry : fs::directory_iterator("tests/scenarios/gsk")) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("double-coil") || entry.path().extension() != ".scn") continue;
    ++count;
    Expectations expected = expectationsOf(entry.path());
    auto compiled = compileFiles(expected.programs, expected.options);
    Codes codes = compiled->codes();
    std::sort(codes.begin(), codes.end());
    EXPECT_EQ(codes, expected.codes) << name << "\n" << compiled->text();
    EXPECT_NE(compiled->module, nullptr) << name;
    expected.options.strict = true;
    EXPECT_EQ(compileFiles(expected.programs, expected.options)->module == nullptr, !codes.empty()) << name;
  }
  EXPECT_EQ(count, 4u);
}

TEST(GskErrorScenarios, NothingElseIsReported) {
  size_t count = 0;
  for (const auto& entry : fs::directory_iterator("tests/scenarios/gsk")) {
    if (entry.path().extension() != ".scn") continue;
    const Expectations expected = expectationsOf(entry.path());
    if (!expected.errors || !expected.everyLineGiven) continue;
    ++count;
    const auto compiled = compileFiles(expected.programs, expected.options);
    Codes codes = compiled->codes();
    std::sort(codes.begin(), codes.end());
    EXPECT_EQ(codes, expected.codes) << entry.path() << '\n' << compiled->text();
  }
  EXPECT_GT(count, 30u);
}

} // namespace
} // namespace rung::frontend::gsk::test
