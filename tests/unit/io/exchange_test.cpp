// Inputs and outputs of one connection: the newest values, and safe ones while the other side is silent.
#include "machine/io/connections/connections.h"
#include "tests/support/faultless_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace rung::io {
namespace {

using ::testing::ElementsAre;

constexpr int64_t kSecond = 1'000'000'000;

host::File mapOf() {
  return test::faultlessMap(R"([in]
run = { type = "bit", name = "X0.0" }
speed = { type = "s32", name = "D0:2" }
load = { type = "float", name = "D4:4" }
count = { type = "u32", name = "D8:4" }
ok = { type = "bit", name = "X0.7" }
[out]
lamp = { type = "bit", name = "Y0.0" }
turns = { type = "s32", name = "D0:2" }
[shared-memory]
name = "a"
timeout = 1
status = "ok"
pins = { run = { at = 0, safe = true }, speed = { at = 4, safe = -3 }, load = { at = 8, safe = "hold" }, count = 16, lamp = 0, turns = 4 }
)");
}

struct Pins {
  bool run = false, ok = true, lamp = false;
  int32_t speed = 0, turns = 0;
  uint32_t count = 0;
  double load = 0;
  host::PinCell cells[7] = {{.bit = &run}, {.s32 = &speed}, {.real = &load}, {.u32 = &count},
                            {.bit = &ok},  {.bit = &lamp},  {.s32 = &turns}};
};

class ExchangeOfAMap : public ::testing::Test {
protected:
  host::File map_ = mapOf();
  Exchange exchange_{map_, map_.connections.at(0)};
  Pins pins_;
};

TEST_F(ExchangeOfAMap, BeginsWithSafeValues) {
  exchange_.readInputs(pins_.cells, 5 * kSecond);
  EXPECT_TRUE(pins_.run);
  EXPECT_EQ(pins_.speed, -3);
  EXPECT_FALSE(pins_.ok);
  EXPECT_FALSE(exchange_.isAlive());
  EXPECT_EQ(exchange_.losses(), 0u) << "it was never there";
}

TEST_F(ExchangeOfAMap, HasWhatTheOtherSideHasSaidLast) {
  exchange_.publish(std::vector<double>{0, 1, 1, 1}, 9 * kSecond);
  exchange_.publish(std::vector<double>{0, -2147483648.0, 2.5, 4294967295.0}, 10 * kSecond);
  exchange_.readInputs(pins_.cells, 10 * kSecond + 1);
  EXPECT_FALSE(pins_.run);
  EXPECT_EQ(pins_.speed, INT32_MIN);
  EXPECT_EQ(pins_.load, 2.5);
  EXPECT_EQ(pins_.count, UINT32_MAX);
  EXPECT_TRUE(pins_.ok);
  EXPECT_EQ(exchange_.exchanges(), 2u);
}

TEST_F(ExchangeOfAMap, HasSafeValuesAfterTheTimeoutAndTheOthersAgainLater) {
  const std::vector<double> values{0, 5, 2.5, 7};
  exchange_.publish(values, 10 * kSecond);
  exchange_.readInputs(pins_.cells, 11 * kSecond);
  EXPECT_EQ(pins_.speed, 5) << "the time is not over";
  exchange_.readInputs(pins_.cells, 11 * kSecond + 1);
  EXPECT_TRUE(pins_.run);
  EXPECT_EQ(pins_.speed, -3);
  EXPECT_EQ(pins_.load, 2.5) << "it holds";
  EXPECT_EQ(pins_.count, 0u);
  EXPECT_FALSE(pins_.ok);
  exchange_.readInputs(pins_.cells, 12 * kSecond);
  EXPECT_EQ(exchange_.losses(), 1u);
  exchange_.publish(values, 13 * kSecond);
  exchange_.readInputs(pins_.cells, 13 * kSecond);
  EXPECT_EQ(pins_.speed, 5);
  EXPECT_TRUE(pins_.ok);
}

TEST_F(ExchangeOfAMap, PassesTheNewestOutputs) {
  pins_.lamp = true;
  pins_.turns = 4;
  exchange_.writeOutputs(pins_.cells);
  pins_.turns = -5;
  exchange_.writeOutputs(pins_.cells);
  EXPECT_THAT(exchange_.newestOutputs(), ElementsAre(1, -5));
  EXPECT_THAT(exchange_.newestOutputs(), ElementsAre(1, -5));
}

} // namespace
} // namespace rung::io
