// Runs over drawings: what lands where, in ladder text and in command lists, and what a page says of it.
#include "tools/view/overlay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/view/drawn.h"
#include "tools/view/html.h"
#include "tools/view/svg.h"

namespace rung::view::test {
namespace {

using Kind = ElementOverlay::Kind;

constexpr std::string_view kLadder = "dialect nct\nmodule MAIN\nrung \"lamp\"\n"
                                     "|--[7000.00]--+--[/7000.01]--(7001.00)\n"
                                     "|--[7000.02]--+\n"
                                     "rung \"time\"\n|--[7000.03]--{TOND 7100 #500 #0}--(7001.01)\n";

std::string badges(const Sheet& sheet) {
  std::string text;
  for (const Cell& cell : sheet.cells)
    if (cell.seen != Seen::Unasked) text += cell.operand.name + cell.title + ":" + cell.badge + ";";
  return text;
}

size_t count(std::string_view text, std::string_view what) {
  size_t n = 0;
  for (size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(ViewOverlay, ElementsAreFoundByTheirPlaces) {
  const auto drawn = draw("t.lad", std::string(kLadder));
  Overlay overlay{.title = "Coverage"};
  overlay.elements = {
      {Kind::Contact, {"t.lad", 4, 4}, true, false, true, ""}, {Kind::Contact, {"t.lad", 4, 18}, true, true, false, ""},
      {Kind::Coil, {"t.lad", 4, 30}, true, true, false, ""},   {Kind::Contact, {"t.lad", 5, 0}, false, false, true, ""},
      {Kind::Box, {"t.lad", 7, 15}, false, true, true, ""},    {Kind::Coil, {"t.lad", 99, 4}, true, true, true, ""},
      {Kind::Coil, {"other.lad", 4, 4}, true, true, true, ""}, {Kind::Coil, {"t.lad", 4, 0}, true, true, true, ""}};
  lay(overlay, drawn->program);
  EXPECT_EQ(badges(drawn->program.figures[0].sheet),
            "7000.00:never closed;7000.01:never decided;7001.00:;7000.02:never ran;");
  EXPECT_EQ(badges(drawn->program.figures[1].sheet), "TOND:never off;");
}

TEST(ViewOverlay, CommandsOfAListAreTheElementsDrawnForThem) {
  const auto drawn = draw("t.pmc", "dialect gsk\nFUNC END1\n; first\nLD X0.0\nOUT Y0.0\n; second\n"
                                   "LD X0.1\nLD X0.2\nANI X0.3\nORB\nOUT Y0.1\nSET R0.0\n"
                                   "LD X0.4\nFUNC TMR\nPRM 1\nOUT R0.1\nFUNC END2\n");
  Overlay overlay;
  for (uint32_t line : {9u, 12u, 14u})
    overlay.elements.push_back({Kind::Contact, {"t.pmc", line, 1}, true, false, true, ""});
  overlay.elements.push_back({Kind::Contact, {"t.pmc", 7, 0}, false, true, true, ""});
  lay(overlay, drawn->program);
  ASSERT_EQ(drawn->program.figures.size(), 3u);
  EXPECT_EQ(badges(drawn->program.figures[1].sheet), "X0.1:never open;X0.3:never closed;R0.0:never closed;");
  EXPECT_EQ(badges(drawn->program.figures[2].sheet), "TMR:never closed;");
}

TEST(ViewOverlay, RungsAreFoundByNumberOrPlace) {
  const auto drawn = draw("t.lad", std::string(kLadder));
  Overlay overlay{.title = "Profile", .summary = {"2 scans & no more"}, .heat = "share of all operations"};
  overlay.rungs.push_back({2, {}, {Run::State::Ran, 0.5, "50 %", "the <worst>"}});
  overlay.rungs.push_back({0, {"t.lad", 3, 0}, {Run::State::Never, 0, "", ""}});
  overlay.rungs.push_back({7, {}, {Run::State::Ran, 0.25, "nowhere", ""}});
  lay(overlay, drawn->program);
  const std::string page = renderHtml(drawn->program);
  EXPECT_EQ(count(page, "class=\"R N\" id=\"r1\""), 1u);
  EXPECT_EQ(count(page, "class=\"R H5\" id=\"r2\""), 1u);
  EXPECT_EQ(count(page, "title=\"the &lt;worst&gt;\""), 2u); // at the rung and in the list
  EXPECT_EQ(count(page, "2 scans &amp; no more"), 1u);
  EXPECT_EQ(count(page, "1 rung never ran: <a href=\"#r1\">1</a>"), 1u);
  EXPECT_EQ(count(page, "most: share of all operations"), 1u);
  EXPECT_EQ(count(page, "nowhere"), 0u);
  const std::string picture = renderSvg(drawn->program);
  EXPECT_EQ(count(picture, "never ran"), 1u);
  EXPECT_EQ(count(picture, "50 %"), 1u);
}

TEST(ViewOverlay, APageWithoutRunsSaysNothingOfThem) {
  const auto drawn = draw("t.lad", std::string(kLadder));
  const std::string page = renderHtml(drawn->program);
  EXPECT_EQ(count(page, "id=\"run\""), 0u);
  EXPECT_EQ(count(page, "never ran"), 0u);
}

TEST(ViewOverlay, StepsOfHeat) {
  const auto step = [](double heat) { return heatStep({Run::State::Ran, heat, "", ""}, 0.2); };
  EXPECT_EQ(step(0), 0);
  EXPECT_EQ(step(0.0001), 1);
  EXPECT_EQ(step(0.1), 3);
  EXPECT_EQ(step(0.2), kHeatSteps);
}

} // namespace
} // namespace rung::view::test
