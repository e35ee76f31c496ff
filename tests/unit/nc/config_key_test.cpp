// Whole numbers and durations of configuration values.
#include <gtest/gtest.h>

#include "rtlib/nc/config_key.h"

namespace rung::nc {
namespace {

TEST(ConfigKey, WholeNumbers) {
  EXPECT_EQ(wholeNumber("0"), 0);
  EXPECT_EQ(wholeNumber("0000000000000000000000012"), 12);
  EXPECT_EQ(wholeNumber("9223372036854775807"), INT64_MAX);
  for (const char* ten : {"+10", "0xA", "16#a", "0b1010", "1_0"}) EXPECT_EQ(wholeNumber(ten), 10) << ten;
  for (const char* wrong : {"", "-1", "1.0", "1 ", "0x", "1__0", "9223372036854775808"})
    EXPECT_EQ(wholeNumber(wrong), -1) << wrong;
}

TEST(ConfigKey, DurationsHaveAUnit) {
  EXPECT_EQ(durationUs("500us"), 500);
  EXPECT_EQ(durationUs("2ms"), 2000);
  EXPECT_EQ(durationUs("1s"), 1'000'000);
  EXPECT_EQ(durationUs("0s"), 0);
  EXPECT_EQ(durationUs("1_000us"), 1000);
  EXPECT_EQ(durationUs("0000000000000000000000100ms"), 100'000);
  for (const char* wrong : {"", "5", "ms", "-1ms", "1.5ms", "1 ms", "1ms ", "1m", "1S", "1min"})
    EXPECT_EQ(durationUs(wrong), -1) << wrong;
}

TEST(ConfigKey, NumbersInKeysAreDigits) {
  const ConfigKey keys[] = {{.key = "table<n>"}, {.key = "<ID>"}};
  EXPECT_EQ(findConfigKey(keys, "table12"), &keys[0]);
  for (const char* other : {"table0x1", "table-1", "table", "table1_0"})
    EXPECT_EQ(findConfigKey(keys, other), &keys[1]);
}

TEST(ConfigKey, LimitsAreRightValues) {
  const ConfigKey whole{.key = "k", .form = ConfigForm::Whole, .least = 3, .most = 5};
  const ConfigKey time{.key = "k", .form = ConfigForm::Duration, .least = 3000, .most = 5000};
  for (const char* right : {"3", "5"}) EXPECT_EQ(wrongValue(whole, "k", right), "");
  for (const char* right : {"3ms", "5ms"}) EXPECT_EQ(wrongValue(time, "k", right), "");
  for (const char* wrong : {"2", "6"}) EXPECT_NE(wrongValue(whole, "k", wrong), "");
  for (const char* wrong : {"2999us", "5001us"}) EXPECT_NE(wrongValue(time, "k", wrong), "");
}

TEST(ConfigKey, NoDurationOverflows) {
  EXPECT_EQ(durationUs("4294967295s"), 4'294'967'295'000'000);
  EXPECT_EQ(durationUs("1000000000000s"), 1'000'000'000'000'000'000);
  EXPECT_EQ(durationUs("1000000000001s"), -1);
  EXPECT_EQ(durationUs("9223372036854775807us"), -1);
}

} // namespace
} // namespace rung::nc
