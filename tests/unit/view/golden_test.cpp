// tests/golden/view: programs beside their pictures, small enough to look at. RUNG_UPDATE=1 draws them anew.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/unit/view/drawn.h"
#include "tools/view/html.h"
#include "tools/view/svg.h"

namespace rung::view::test {
namespace {

const std::filesystem::path kFolder = "tests/golden/view";

std::string readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void compare(const std::filesystem::path& expected, const std::string& text) {
  if (std::getenv("RUNG_UPDATE") != nullptr) std::ofstream(expected, std::ios::binary) << text;
  EXPECT_EQ(readFile(expected), text) << expected;
}

TEST(ViewGolden, AllPrograms) {
  size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".lad" && path.extension() != ".pmc") continue;
    ++count;
    const auto drawn = draw(path.filename(), readFile(path));
    ASSERT_NE(drawn, nullptr) << path;
    compare(std::filesystem::path(path).replace_extension(".svg"), renderSvg(drawn->program));
    compare(std::filesystem::path(path).replace_extension(".html"), renderHtml(drawn->program));
  }
  EXPECT_GT(count, 0u) << "run in the root of the repository";
}

} // namespace
} // namespace rung::view::test
