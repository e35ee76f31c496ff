// Where timers are, by what their tables say.
#include "rtlib/run/timer_state.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "tests/unit/rtlib/test_program.h"

namespace rung::runtime {
namespace {

using test::TestProgram;

constexpr uint32_t kMs[] = {1000, 10'000, 1'000'000};

struct TimerTest : testing::Test {
  TestProgram test;
  std::vector<uint8_t> block = std::vector<uint8_t>(256);
  rung_timer timer{.name = "T",
                   .preset = 5000,
                   .units = kMs,
                   .unit_count = 1,
                   .rung = RUNG_NONE,
                   .time_us = 1,
                   .time_type = RUNG_TYPE_I64,
                   .time_space = RUNG_NONE,
                   .time_at = 32,
                   .running_at = RUNG_NONE};

  TimerTest() {
    test.addPacked("D", 1, 16, 64);
    test.link();
  }
  template <class T>
  void put(uint32_t offset, T value) {
    std::memcpy(block.data() + offset, &value, sizeof value);
  }
  TimerState state() { return stateOf({test.program, block.data()}, timer); }
  // "elapsed of preset, remaining left", or "off of preset".
  std::string text() {
    const TimerState now = state();
    const std::string of = " of " + std::to_string(now.preset);
    if (!now.running) return (now.elapsed == 0 && now.remaining == 0 ? "off" : "wrong") + of;
    return std::to_string(now.elapsed) + of + ", " + std::to_string(now.remaining) + " left";
  }
};

TEST_F(TimerTest, TimeThatGrows) {
  put<int64_t>(32, INT64_MIN / 2);
  EXPECT_EQ(text(), "off of 5000000") << "idle";
  put<int64_t>(32, 0);
  EXPECT_EQ(text(), "off of 5000000");
  put<int64_t>(32, 1'200'000);
  EXPECT_EQ(text(), "1200000 of 5000000, 3800000 left");
  put<int64_t>(32, 5'000'000);
  EXPECT_EQ(text(), "off of 5000000") << "it is over";
  put<int64_t>(32, INT64_MAX / 2);
  EXPECT_EQ(text(), "off of 5000000");
  timer.preset = -1;
  put<int64_t>(32, 7);
  EXPECT_EQ(text(), "7 of -1, -1 left") << "the preset is not known";
}

TEST_F(TimerTest, TimeThatFalls) {
  timer.flags = RUNG_TIMER_DOWN;
  timer.time_us = 1000;
  timer.time_type = RUNG_TYPE_I32;
  timer.time_space = 0;
  timer.time_at = 4;
  timer.running_at = 40;
  put<int32_t>(68, 1500);
  EXPECT_EQ(text(), "off of 5000000") << "its register has the preset";
  put<uint8_t>(40, 1);
  EXPECT_EQ(text(), "3500000 of 5000000, 1500000 left");
  put<int32_t>(68, 0);
  EXPECT_EQ(text(), "off of 5000000");
  put<int32_t>(68, -4);
  EXPECT_EQ(text(), "off of 5000000");
  put<int32_t>(68, 9000);
  EXPECT_EQ(text(), "0 of 5000000, 9000000 left") << "the program has written into the register";
  timer.preset = -1;
  EXPECT_EQ(text(), "-1 of -1, 9000000 left");
}

TEST_F(TimerTest, PresetAndUnitInCells) {
  timer.preset_type = RUNG_TYPE_I16;
  timer.preset_space = 0;
  timer.preset_at = 2;
  timer.unit_count = 3;
  timer.unit_type = RUNG_TYPE_I16;
  timer.unit_space = 0;
  timer.unit_at = 6;
  put<int64_t>(32, 1000);
  put<uint16_t>(66, 0xFFFF);
  EXPECT_EQ(state().preset, 65'535'000) << "without a sign";
  put<uint16_t>(70, 2);
  EXPECT_EQ(state().preset, 65'535'000'000);
  put<uint16_t>(70, 3);
  EXPECT_EQ(state().preset, 65'535'000) << "no such unit counts as 0";
}

TEST_F(TimerTest, RunsOfAByte) {
  timer.flags = RUNG_TIMER_RUNS;
  timer.units = &(timer.unit_count = 1);
  timer.preset = 200;
  timer.time_type = RUNG_TYPE_I8;
  put<uint8_t>(32, 150);
  EXPECT_EQ(text(), "150 of 200, 50 left");
}

TEST_F(TimerTest, NothingOverflows) {
  timer.preset = INT64_MAX;
  timer.time_us = UINT32_MAX;
  for (const int64_t time : {INT64_MIN, int64_t{-1}, int64_t{1}, INT64_MAX}) {
    put<int64_t>(32, time);
    const TimerState now = state();
    EXPECT_EQ(now.preset, INT64_MAX);
    EXPECT_GE(now.elapsed, 0);
    EXPECT_GE(now.remaining, 0);
  }
}

} // namespace
} // namespace rung::runtime
