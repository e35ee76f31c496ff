// Values of scenarios: integers as patterns of their width, tolerances, ranges.
#include <gtest/gtest.h>

#include "tools/scenario/values.h"

namespace rung::scenario {
namespace {

Statement statement(const std::string& line) { return parse("t.scn", "program a\n" + line + "\n").statements.at(1); }

Reading integer(uint64_t value, uint32_t width) {
  Reading reading;
  reading.integer = value;
  reading.width = width;
  reading.real = static_cast<double>(value);
  return reading;
}

TEST(ScenarioValues, IntegersCompareModuloTheirWidth) {
  EXPECT_EQ(checkValue(integer(0xFF, 8), statement("expect D0 -1")), "");
  EXPECT_EQ(checkValue(integer(0xFF, 8), statement("expect D0 255")), "");
  EXPECT_NE(checkValue(integer(0xFF, 16), statement("expect D0 -1")), "");
  EXPECT_NE(checkValue(integer(1, 8), statement("expect D0 2")).find("D0 is 1 (0x1), expected 2"), std::string::npos);
}

TEST(ScenarioValues, WhatTheCellNeverHoldsIsNotExpected) {
  EXPECT_EQ(checkValue(integer(44, 8), statement("expect D0 300")),
            "D0 is 44 (0x2C), and an integer of 8 bits takes -128 to 255, not 300");
  EXPECT_EQ(checkValue(integer(0, 8), statement("expect D0 256")),
            "D0 is 0 (0x0), and an integer of 8 bits takes -128 to 255, not 256");
  EXPECT_NE(checkValue(integer(0xFF, 8), statement("expect D0 18446744073709551615")), ""); // which is not -1
  EXPECT_NE(checkValue(integer(0x7F, 8), statement("expect D0 -129")), "");
  EXPECT_EQ(checkValue(integer(0, 1), statement("expect X0.0 2")), "X0.0 is 0, and a bit takes 0 or 1, not 2");
  EXPECT_NE(checkValue(integer(1, 1), statement("expect X0.0 -1")), "");
  EXPECT_EQ(checkValue(integer(UINT64_MAX, 64), statement("expect Q 18446744073709551615")), "");
  EXPECT_EQ(checkValue(integer(UINT64_MAX, 64), statement("expect Q -1")), "");
}

TEST(ScenarioValues, CellsOfTheNcHoldWhatTheirBitsHold) {
  const auto wrong = [](const sim::NcCell& cell, const char* value) {
    return cellProblem(cell, statement(std::string("set C ") + value).value);
  };
  EXPECT_EQ(wrong({.width = 8}, "255"), "");
  EXPECT_EQ(wrong({.width = 8}, "256"), "an integer of 8 bits takes -128 to 255, not 256");
  EXPECT_EQ(wrong({.width = 32, .untyped = true}, "1.5"),
            "the cell has 32 bits, so it cannot be 1.5: a real number needs 64");
  EXPECT_EQ(wrong({.width = 64, .untyped = true}, "1.5"), "");
  EXPECT_EQ(wrong({.isReal = true, .width = 64}, "99999999999999999999"), "");
  EXPECT_EQ(wrong({.width = 64, .untyped = true}, "99999999999999999999"),
            "an integer of 64 bits takes -9223372036854775808 to 18446744073709551615, not 99999999999999999999");
  const sim::NcCell cell = cellOf(statement("set C 99999999999999999999").value);
  EXPECT_TRUE(cell.isReal);
  EXPECT_EQ(std::bit_cast<double>(cell.bits), 1e20);
}

TEST(ScenarioValues, RealsHaveATolerance) {
  EXPECT_EQ(checkValue(realReading(1.505), statement("expect F ~ 1.5 0.01")), "");
  EXPECT_NE(checkValue(realReading(1.52), statement("expect F ~ 1.5 0.01")), "");
  EXPECT_NE(checkValue(realReading(1.5000001), statement("expect F 1.5")), "");
}

TEST(ScenarioValues, RangesAreUnsignedUnlessTheLowBoundIsNegative) {
  EXPECT_EQ(checkRange(integer(200, 8), statement("expect_range D0 100 250")), "");
  EXPECT_EQ(checkRange(integer(0xFE, 8), statement("expect_range D0 -3 0")), "");
  EXPECT_NE(checkRange(integer(0xFE, 8), statement("expect_range D0 0 100")), "");
  EXPECT_EQ(checkRange(integer(5, 32), statement("expect_range D0 0 18446744073709551616")),
            "D0 is 5 (0x5), and an integer of 32 bits takes -2147483648 to 4294967295, not 18446744073709551616");
  EXPECT_EQ(checkRange(realReading(5), statement("expect_range R 0 18446744073709551616")), "");
}

TEST(ScenarioValues, MessagesCompareTheirProperties) {
  const nc::ShownMessage message{20, 1, 2, 33, false, "Mount tool 7"};
  EXPECT_EQ(
      messageDifference(message, statement("expect_message 20 channel=1 index=2 value=33 text=\"Mount tool 7\"").keys),
      "");
  EXPECT_NE(messageDifference(message, statement("expect_message 20 channel=2").keys), "");
  EXPECT_NE(messageDifference(message, statement("expect_message 20 colour=2").keys).find("no property"),
            std::string::npos);
}

} // namespace
} // namespace rung::scenario
