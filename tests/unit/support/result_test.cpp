// Result, RUNG_CHECK and ids.
#include <memory>

#include <gtest/gtest.h>

#include "ir/support/check.h"
#include "ir/support/ids.h"
#include "ir/support/result.h"

namespace rung {
namespace {

Result<int> half(int value) {
  if (value % 2 != 0) return failure("odd");
  return value / 2;
}

Result<std::string> halfAsText(int value) {
  Result<int> result = half(value);
  if (!result) return result.failure();
  return std::to_string(result.value());
}

TEST(Result, HoldsAValue) {
  const Result<int> result = half(8);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value(), 4);
}

TEST(Result, HoldsAnErrorAndPassesItOn) {
  const Result<std::string> result = halfAsText(7);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error(), "odd");
}

TEST(Result, OfTextKeepsValueAndErrorApart) {
  EXPECT_TRUE(Result<std::string>(std::string("odd")).ok());
  EXPECT_FALSE(Result<std::string>(failure("odd")).ok());
}

TEST(Result, MovesValuesThatCannotBeCopied) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(3));
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 3);
}

TEST(Result, WithoutValue) {
  EXPECT_TRUE(Result<void>().ok());
  EXPECT_EQ(Result<void>(failure("no")).error(), "no");
}

TEST(ResultDeathTest, ValueOfAnErrorEndsTheProgram) {
  EXPECT_DEATH(static_cast<void>(half(7).value()), "failed Result");
}

TEST(CheckDeathTest, SaysWhatAndWhere) {
  RUNG_CHECK(true, "fine");
  EXPECT_DEATH(RUNG_CHECK(1 > 2, "numbers"), "result_test.cpp:[0-9]+: internal error: numbers");
}

TEST(Id, IsInvalidUntilItGetsAnIndex) {
  using ThingId = Id<struct ThingTag>;
  EXPECT_FALSE(ThingId().valid());
  EXPECT_TRUE(ThingId{0}.valid());
  EXPECT_LT(ThingId{1}, ThingId{2});
}

} // namespace
} // namespace rung
