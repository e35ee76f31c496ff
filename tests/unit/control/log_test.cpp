// The lines of a host: their times, and what becomes of one that comes again and again.
#include "machine/control/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace rung::control {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Clock final : runtime::Clock {
  int64_t seconds = 1'000'000'000;
  int64_t nowNs() noexcept override { return seconds * 1'000'000'000; }
  int64_t dateNs() noexcept override { return seconds * 1'000'000'000; }
  void sleep(int64_t ns) override { seconds += ns / 1'000'000'000; }
};

struct LogTest : ::testing::Test {
  Clock clock;
  std::vector<std::string> lines;
  std::unique_ptr<Log> log = std::make_unique<Log>(clock, [this](const std::string& line) { lines.push_back(line); });
  std::string at(int64_t seconds) const { return dateText(seconds) + " "; }
};

TEST_F(LogTest, EachLineHasItsTime) {
  const int64_t begin = clock.seconds;
  EXPECT_TRUE(log->line("one"));
  clock.seconds += 3;
  log->always("two");
  EXPECT_THAT(lines, ElementsAre(at(begin) + "one", at(begin + 3) + "two"));
}

TEST_F(LogTest, WhatComesAgainAndAgainIsCounted) {
  const int64_t begin = clock.seconds;
  for (uint32_t i = 0; i < Log::kMost; ++i) EXPECT_TRUE(log->line("link lost")) << i;
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(log->line("link lost")) << i;
  EXPECT_TRUE(log->line("another")) << "each line for itself";
  EXPECT_EQ(lines.size(), Log::kMost + 1);
  lines.clear();
  clock.seconds += Log::kPauseS - 1;
  log->tick();
  EXPECT_THAT(lines, IsEmpty());
  ++clock.seconds;
  log->tick();
  EXPECT_THAT(lines, ElementsAre(at(begin) + "link lost (1000 times more since " + dateText(begin) + ")"));
  EXPECT_TRUE(log->line("link lost")) << "it is written again";
}

TEST_F(LogTest, WhatFlapsForDaysTakesLinesNowAndThen) {
  for (int i = 0; i < 100'000; ++i) {
    log->line("link lost");
    log->line("link is back");
    if (i % 10 == 0) ++clock.seconds;
  }
  EXPECT_LT(lines.size(), size_t{2} * (Log::kMost + 1) * (10'000 / Log::kPauseS + 1));
}

TEST_F(LogTest, ManyTextsAreNotKept) {
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(log->line("text " + std::to_string(i)));
  EXPECT_EQ(lines.size(), 1000u);
}

TEST_F(LogTest, WhatWasCountedIsWrittenAtTheEnd) {
  for (uint32_t i = 0; i < Log::kMost + 2; ++i) log->line("lost");
  lines.clear();
  log.reset();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], ::testing::HasSubstr("lost (2 times more since "));
}

TEST_F(LogTest, AClockThatIsSetBackHoldsNothingUp) {
  for (uint32_t i = 0; i < Log::kMost + 2; ++i) log->line("lost");
  clock.seconds -= 3600;
  lines.clear();
  EXPECT_TRUE(log->line("lost"));
}

TEST_F(LogTest, ATextIsOneLineAndDoesNothingToATerminal) {
  log->line("a\nb\x1b[2J\x7f");
  EXPECT_EQ(lines[0], at(clock.seconds) + "a\\x0ab\\x1b[2J\\x7f");
}

} // namespace
} // namespace rung::control
