// `allow(CODE)` in comments.
#include "ir/support/allowance.h"

#include <gtest/gtest.h>

namespace {

using rung::allows;
using rung::withoutAllowances;

TEST(Allowance, IsFoundByItsCode) {
  EXPECT_TRUE(allows("spare input, allow(unused-name)", "unused-name"));
  EXPECT_FALSE(allows("spare input, allow(unused-name)", "unused"));
  EXPECT_FALSE(allows("spare input", "unused-name"));
  for (const char* both : {"allow(never-read, never-reset)", "x allow( never-reset ,never-read ) y"}) {
    EXPECT_TRUE(allows(both, "never-read")) << both;
    EXPECT_TRUE(allows(both, "never-reset")) << both;
    EXPECT_FALSE(allows(both, "never")) << both;
  }
  EXPECT_FALSE(allows("allow(never-read never-reset)", "never-read")); // no list
}

TEST(Allowance, HasItsCodes) {
  EXPECT_EQ(rung::allowedCodes("allow(never-read, odd) and allow(x)"),
            (std::vector<std::string_view>{"never-read", "odd", "x"}));
  EXPECT_TRUE(rung::allowedCodes("none").empty());
}

TEST(Allowance, IsNoPartOfTheRemark) {
  EXPECT_EQ(withoutAllowances("allow(never-read)"), "");
  EXPECT_EQ(withoutAllowances("spare input, allow(unused-name)"), "spare input");
  EXPECT_EQ(withoutAllowances("spare input; allow(unused-name) allow(never-read)"), "spare input");
  EXPECT_EQ(withoutAllowances("allow(unused-name), spare input"), "spare input");
  EXPECT_EQ(withoutAllowances("spare allow(unused-name) input"), "spare input");
  EXPECT_EQ(withoutAllowances("spare, allow(never-read, never-reset)"), "spare");
}

TEST(Allowance, OtherTextsStay) {
  for (const char* text :
       {"", "door open, ", "allow (door)", "allow(", "allow()", "allow(two words)", "allow(a, two words)", "lamp; off"})
    EXPECT_EQ(withoutAllowances(text), text);
}

} // namespace
