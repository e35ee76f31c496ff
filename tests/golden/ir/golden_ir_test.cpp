// Goldens of the IR. text/*.rir: canonical texts, which print as they stand. verify/*.rir: modules with errors; behind
// the module stand, as comments that begin with `;! `, the errors as they are rendered. RUNG_UPDATE=1 rewrites both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "ir/text/text.h"
#include "ir/verify/verify.h"

namespace rung::ir {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ";! ";

std::string read(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

std::vector<fs::path> casesIn(const char* folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path("tests/golden/ir") / folder))
    if (entry.path().extension() == ".rir") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void expectGolden(const fs::path& file, const std::string& actual) {
  if (std::getenv("RUNG_UPDATE") != nullptr) std::ofstream(file, std::ios::binary) << actual;
  EXPECT_EQ(actual, read(file)) << file;
}

Module moduleIn(const fs::path& file) {
  ParseOutcome parsed = parse(read(file));
  EXPECT_TRUE(parsed.module) << file << ':' << parsed.error.line << ':' << parsed.error.column << ": "
                             << parsed.error.message;
  return parsed.module ? std::move(*parsed.module) : Module{};
}

TEST(GoldenText, PrintsAsItStands) {
  const std::vector<fs::path> files = casesIn("text");
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    const Module module = moduleIn(file);
    const std::vector<VerifyError> errors = verify(module, Mode::Final);
    EXPECT_TRUE(errors.empty()) << file << '\n' << render(module, errors);
    expectGolden(file, print(module));
  }
}

TEST(GoldenVerify, RendersItsErrors) {
  const std::vector<fs::path> files = casesIn("verify");
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    const Module module = moduleIn(file);
    const std::vector<VerifyError> errors = verify(module, Mode::Final);
    EXPECT_FALSE(errors.empty()) << file;
    const std::string text = read(file);
    const size_t mark = text.find("\n" + std::string(kMark));
    std::string actual = text.substr(0, mark == std::string::npos ? mark : mark + 1);
    std::istringstream lines(render(module, errors));
    for (std::string line; std::getline(lines, line);) actual += std::string(kMark) + line + '\n';
    expectGolden(file, actual);
  }
}

} // namespace
} // namespace rung::ir
