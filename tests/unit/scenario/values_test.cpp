// Values of scenarios: integers modulo their width, tolerances, ranges.
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

TEST(ScenarioValues, RealsHaveATolerance) {
  EXPECT_EQ(checkValue(realReading(1.505), statement("expect F ~ 1.5 0.01")), "");
  EXPECT_NE(checkValue(realReading(1.52), statement("expect F ~ 1.5 0.01")), "");
  EXPECT_NE(checkValue(realReading(1.5000001), statement("expect F 1.5")), "");
}

TEST(ScenarioValues, RangesAreUnsignedUnlessTheLowBoundIsNegative) {
  EXPECT_EQ(checkRange(integer(200, 8), statement("expect_range D0 100 250")), "");
  EXPECT_EQ(checkRange(integer(0xFE, 8), statement("expect_range D0 -3 0")), "");
  EXPECT_NE(checkRange(integer(0xFE, 8), statement("expect_range D0 0 100")), "");
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
