// tests/golden/view: programs beside their pictures, small enough to look at. RUNG_UPDATE=1 draws them anew.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/view/drawn.h"
#include "tools/view/html.h"
#include "tools/view/overlay.h"
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

// Every look of a rung and of an element that runs give them.
TEST(ViewGolden, Runs) {
  const auto drawn = draw("shapes.lad", readFile(kFolder / "shapes.lad"));
  ASSERT_NE(drawn, nullptr);
  Overlay overlay{.title = "Coverage", .summary = {"Two scenarios, 1,204 scans."}, .heat = "share of all operations"};
  const double shares[] = {0.4, 0.25, 0, 0.02, 0, 0.33};
  uint32_t number = 0;
  for (double share : shares) {
    const auto state = share > 0 ? Run::State::Ran : Run::State::Never;
    const std::string label = share > 0 ? fmt::format("{:.0f} operations, {:.0f} %", share * 3000, share * 100) : "";
    overlay.rungs.push_back({++number, {}, {state, share, label, share > 0.3 ? "2 of 3 scans" : ""}});
  }
  uint32_t bits = 0;
  for (const Figure& figure : drawn->program.figures) {
    for (const Cell& cell : figure.sheet.cells) {
      if (cell.place.line == 0) continue;
      const auto kind = cell.kind == Cell::Kind::Contact ? ElementOverlay::Kind::Contact
                        : cell.kind == Cell::Kind::Coil  ? ElementOverlay::Kind::Coil
                                                         : ElementOverlay::Kind::Box;
      ++bits;
      overlay.elements.push_back({kind,
                                  {"shapes.lad", cell.place.line, cell.place.column},
                                  (bits & 1) != 0,
                                  (bits & 2) != 0,
                                  bits % 3 > 0,
                                  fmt::format("{} times", bits)});
    }
  }
  lay(overlay, drawn->program);
  compare(kFolder / "runs.svg", renderSvg(drawn->program));
  compare(kFolder / "runs.html", renderHtml(drawn->program));
  compare(kFolder / "table.html", renderTable("A table", "NCT", rowsOf(*drawn->module), overlay));
}

} // namespace
} // namespace rung::view::test
