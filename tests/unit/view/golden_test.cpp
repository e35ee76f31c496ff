// tests/golden/view: programs beside their pictures, small enough to look at.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/golden.h"
#include "tests/unit/view/drawn.h"
#include "tools/view/html.h"
#include "tools/view/overlay.h"
#include "tools/view/svg.h"

namespace rung::view::test {
namespace {

using rung::test::Golden;

void expectPrograms(Golden& golden) {
  for (const std::filesystem::path& path : golden.inputs()) {
    const auto drawn = draw(path.filename(), golden.read(path));
    ASSERT_NE(drawn, nullptr) << path;
    golden.expect(path, ".svg", renderSvg(drawn->program));
    golden.expect(path, ".html", renderHtml(drawn->program));
  }
}

// Every look of a rung and of an element that runs give them.
void expectRuns(Golden& golden) {
  const auto drawn = draw("shapes.lad", golden.read("tests/golden/view/shapes.lad"));
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
  golden.expect("runs.svg", renderSvg(drawn->program));
  golden.expect("runs.html", renderHtml(drawn->program));
}

TEST(ViewGolden, All) {
  Golden golden("tests/golden/view", {".lad", ".mne", ".pmc", ".plc"});
  expectPrograms(golden);
  expectRuns(golden);
}

} // namespace
} // namespace rung::view::test
