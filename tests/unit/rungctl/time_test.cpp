// Points of time as `rungctl log --since` takes them.
#include <gtest/gtest.h>

#include <ctime>

#include "machine/rungctl/log.h"

namespace rung::rungctl {
namespace {

constexpr int64_t kNow = 1'795'963'951; // a day in 2026

std::string at(std::optional<int64_t> time) {
  if (!time) return "none";
  const auto seconds = static_cast<std::time_t>(*time);
  std::tm parts{};
  localtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
  return text;
}

TEST(TimeOf, PointsOfTime) {
  const std::string today = at(kNow).substr(0, 11);
  EXPECT_EQ(at(timeOf("2026-11-29", kNow)), "2026-11-29 00:00:00");
  EXPECT_EQ(at(timeOf("2026-11-29 14:38", kNow)), "2026-11-29 14:38:00");
  EXPECT_EQ(at(timeOf("2026-11-29 14:38:05", kNow)), "2026-11-29 14:38:05");
  EXPECT_EQ(at(timeOf("2026-07-01 14:38:05", kNow)), "2026-07-01 14:38:05") << "daylight saving time";
  EXPECT_EQ(at(timeOf("14:38", kNow)), today + "14:38:00");
  EXPECT_EQ(at(timeOf("04:08:09", kNow)), today + "04:08:09");
}

TEST(TimeOf, TimesAgo) {
  EXPECT_EQ(timeOf("90s", kNow), kNow - 90);
  EXPECT_EQ(timeOf("10m", kNow), kNow - 600);
  EXPECT_EQ(timeOf("2h", kNow), kNow - 7200);
  EXPECT_EQ(timeOf("3d", kNow), kNow - 259'200);
  EXPECT_EQ(timeOf("0s", kNow), kNow);
}

TEST(TimeOf, OtherTexts) {
  for (const char* text : {"", "s", "-1s", "1.5h", "99999999d", "soon", "2026-13-01", "2026-11-29 25:00", "14:38:05 ",
                           "14", "2026-11-29T14:38"})
    EXPECT_EQ(timeOf(text, kNow), std::nullopt) << text;
}

} // namespace
} // namespace rung::rungctl
