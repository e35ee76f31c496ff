// The page of two versions: what is marked in changed rungs, what is folded, and what only one version has.
#include "tools/view/compare_html.h"

#include <gtest/gtest.h>

#include <string_view>

#include "tests/unit/view/drawn.h"

namespace rung::view::test {
namespace {

using State = ComparedRung::State;

constexpr std::string_view kBefore = "dialect nct\nmodule MAIN\n"
                                     "rung \"lamp\"\n|--[7000.00]--[/7000.01]--(7001.00)\n"
                                     "rung \"same\"\n|--[7000.03]--(7001.01)\n"
                                     "rung \"old & gone\"\n|--[7000.04]--(7001.02)\n";
constexpr std::string_view kAfter = "dialect nct\nmodule MAIN\n"
                                    "rung \"lamp\"\n|--[7000.00]--[7000.01]--(7001.00)\n"
                                    "rung \"same\"\n|--[7000.03]--(7001.01)\n"
                                    "rung \"new\"\n|--[7000.05]--(7001.03)\n";

size_t count(std::string_view text, std::string_view what) {
  size_t n = 0;
  for (size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::string page(const std::vector<ComparedRung>& rungs, std::vector<ComparedTable> tables = {}) {
  return renderComparison(draw("a.lad", std::string(kBefore))->program, draw("b.lad", std::string(kAfter))->program,
                          {.before = "a", .after = "b <new>", .rungs = rungs, .tables = std::move(tables)});
}

TEST(ViewCompare, OnlyWhatDiffersIsMarked) {
  const std::string text = page({{State::Changed, 1, 1, {"leads to x"}}});
  EXPECT_EQ(count(text, "class=\"qp\""), 2u); // the contact that is negated no more, in both versions
  EXPECT_EQ(count(text, "only in the older version"), 1u);
  EXPECT_EQ(count(text, "only in the newer version"), 1u);
  EXPECT_EQ(count(text, "<article>"), 2u);
  EXPECT_NE(text.find("leads to x"), std::string::npos);
  EXPECT_EQ(count(page({{State::Moved, 2, 2, {}}}), "class=\"qp\""), 0u);
}

TEST(ViewCompare, TheRestIsFoldedOrAlone) {
  const std::string text =
      page({{State::Same, 1, 1, {}}, {State::Same, 2, 2, {}}, {State::Removed, 3, 0, {}}, {State::Added, 0, 3, {}}});
  EXPECT_EQ(count(text, "<details>"), 1u);
  EXPECT_NE(text.find("2 unchanged rungs: 1 to 2"), std::string::npos);
  EXPECT_EQ(count(text, "<article>"), 4u);
  EXPECT_EQ(count(text, "<div class=\"none\">"), 2u);
  EXPECT_NE(text.find("old &amp; gone"), std::string::npos);
  EXPECT_NE(text.find("b &lt;new&gt;"), std::string::npos);
  EXPECT_LT(text.find("old &amp; gone"), text.find("> new <"));
}

TEST(ViewCompare, OtherDifferences) {
  const std::string text = page({}, {{"Names", {{"changed", "LAMP", "Y1.0", "Y<2>"}}}, {"Messages", {}}});
  EXPECT_EQ(count(text, "<table>"), 1u);
  EXPECT_NE(text.find("Y&lt;2&gt;"), std::string::npos);
}

} // namespace
} // namespace rung::view::test
