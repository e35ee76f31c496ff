// When messages came and went, in memory and in a file that survives crashes and full disks.
#include "machine/control/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rung::control {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int64_t kBegin = 1'700'000'000;
const History::Key kDoor{3, 0, 0};
const History::Key kOil{4, 0, 0};

// "DOOR 0-5", "DOOR 0-on", "fault 7"; "x2" where it came as often, "!" where the host ended meanwhile.
std::vector<std::string> shown(const History& history) {
  std::vector<std::string> lines;
  for (const History::Entry& entry : history.entries()) {
    std::string line = entry.text + " " + std::to_string(entry.cameS - kBegin);
    if (entry.wentS) line += "-" + std::to_string(*entry.wentS - kBegin);
    if (history.isOn(entry)) line += "-on";
    if (entry.times != 1) line += " x" + std::to_string(entry.times);
    lines.push_back(line + (entry.cut ? "!" : ""));
  }
  return lines;
}

TEST(History, MessagesComeAndGo) {
  History history;
  history.come(kDoor, "DOOR", kBegin, false);
  history.come(kOil, "OIL", kBegin + 1, false);
  history.happen("fault", kBegin + 2);
  EXPECT_EQ(history.go(kDoor, kBegin + 5), "DOOR");
  EXPECT_EQ(history.go(kDoor, kBegin + 6), "") << "it was not on";
  EXPECT_THAT(shown(history), ElementsAre("DOOR 0-5", "OIL 1-on", "fault 2"));
  ASSERT_EQ(history.shown().size(), 1u);
  EXPECT_EQ(history.shown()[0].text, "OIL");
  history.goAll(kBegin + 9);
  EXPECT_TRUE(history.shown().empty());
  EXPECT_THAT(shown(history), ElementsAre("DOOR 0-5", "OIL 1-9", "fault 2"));
}

TEST(History, OneThatIsOnAndIsShownAgainIsOneEntry) {
  History history;
  history.come(kDoor, "DOOR", kBegin, false);
  history.come(kDoor, "DOOR", kBegin + 1, false);
  EXPECT_THAT(shown(history), ElementsAre("DOOR 0-on"));
  history.come(kDoor, "DOOR of tool 7", kBegin + 2, false); // with another value
  EXPECT_THAT(shown(history), ElementsAre("DOOR 0-2", "DOOR of tool 7 2-on"));
}

TEST(History, AMessageThatFlickersIsCounted) {
  History history;
  for (int i = 0; i < 100; ++i) {
    history.come(kDoor, "DOOR", kBegin + i, i >= 5);
    history.go(kDoor, kBegin + i);
  }
  EXPECT_EQ(history.entries().size(), 5u);
  EXPECT_EQ(shown(history).back(), "DOOR 4-99 x96");
}

TEST(History, WhatIsOnOutlivesItsEntry) {
  History history;
  history.come(kDoor, "DOOR", kBegin, false);
  for (size_t i = 0; i < History::kMost; ++i) history.happen("event", kBegin + 1);
  EXPECT_EQ(history.entries().size(), History::kMost);
  EXPECT_EQ(history.entries().front().text, "event");
  ASSERT_EQ(history.shown().size(), 1u);
  EXPECT_EQ(history.shown()[0].cameS, kBegin);
  EXPECT_EQ(history.go(kDoor, kBegin + 2), "DOOR");
  EXPECT_TRUE(history.shown().empty());
}

// ---- lines

TEST(History, LinesGiveBackWhatWasWritten) {
  History before;
  before.come(kDoor, "DOOR \"A\"\n\xff", kBegin, false);
  std::string text = before.takeLines(kBegin);
  EXPECT_EQ(before.takeLines(kBegin), "") << "nothing has changed";
  before.go(kDoor, kBegin + 4);
  before.happen("fault", kBegin + 5);
  before.come(kOil, "OIL", kBegin + 6, false);
  text += before.takeLines(kBegin + 6);
  History after;
  EXPECT_TRUE(after.read(text));
  EXPECT_THAT(shown(after), ElementsAre(HasSubstr("DOOR \"A\"\n"), "fault 5", "OIL 6!"));
  EXPECT_EQ(after.entries()[0].wentS, kBegin + 4);
  EXPECT_TRUE(after.shown().empty()) << "the host has ended: none is on";
  after.happen("begun", kBegin + 20);
  EXPECT_TRUE(after.isNew(after.entries().back()));
  EXPECT_FALSE(after.isNew(after.entries().front()));
  EXPECT_EQ(after.entries().back().number, 4u);
}

TEST(History, ARegularEndSaysUntilWhenTheyWereOn) {
  History before;
  before.come(kDoor, "DOOR", kBegin, false);
  before.end(kBegin + 8);
  History after;
  EXPECT_TRUE(after.read(before.takeAll()));
  EXPECT_THAT(shown(after), ElementsAre("DOOR 0-8!"));
}

TEST(History, DamagedLinesAreLeftOut) {
  History before;
  before.happen("one", kBegin);
  before.happen("two", kBegin + 1);
  const std::string good = before.takeAll();
  const std::string torn = good.substr(0, good.size() - 5);
  History after;
  EXPECT_FALSE(after.read(torn));
  EXPECT_THAT(shown(after), ElementsAre("one 0"));
  History other;
  EXPECT_FALSE(other.read("\xff\n[]\n5\n{\"n\":-1}\n{\"n\":1,\"came\":\"x\",\"text\":5}\n{\"n\":1}\n" + good));
  EXPECT_THAT(shown(other), ElementsAre("one 0", "two 1"));
}

// A message of each scan must not wear the disk out, nor push the others out of the file.
TEST(History, WhatChangesAllTheTimeIsWrittenNowAndThen) {
  History history;
  size_t lines = 0;
  constexpr int kSeconds = 100;
  for (int i = 0; i < kSeconds * 100; ++i) {
    const int64_t now = kBegin + i / 100;
    history.come(kDoor, "DOOR", now, i >= 5);
    history.go(kDoor, now);
    const std::string text = history.takeLines(now);
    lines += static_cast<size_t>(std::ranges::count(text, '\n'));
  }
  EXPECT_LT(lines, 40u);
  const std::string text = history.takeLines(kBegin + kSeconds + History::kPauseS);
  EXPECT_THAT(text, HasSubstr("\"times\":9996")) << "what it was at last is written, too";
  EXPECT_EQ(history.takeLines(kBegin + 1000), "");
}

TEST(History, AFloodOfTextsIsLimited) {
  History history;
  for (int i = 0; i < 500; ++i) history.happen("event " + std::to_string(i), kBegin);
  const std::string first = history.takeLines(kBegin);
  EXPECT_EQ(static_cast<uint32_t>(std::ranges::count(first, '\n')), History::kMostLines);
  EXPECT_EQ(history.takeLines(kBegin), "");
  EXPECT_EQ(static_cast<uint32_t>(std::ranges::count(history.takeLines(kBegin + 1), '\n')), History::kMostLines)
      << "the next second";
}

// Somebody sets the clock, or it had no battery.
TEST(History, AClockThatIsSetBackHoldsUpNoLine) {
  constexpr int64_t kHour = 3600;
  History history;
  for (int i = 0; i < 3; ++i) { // it has had its lines
    history.come(kDoor, "DOOR", kBegin, i != 0);
    history.takeLines(kBegin);
    history.go(kDoor, kBegin);
    history.takeLines(kBegin);
  }
  history.come(kDoor, "DOOR", kBegin - kHour, true);
  EXPECT_THAT(history.takeLines(kBegin - kHour), HasSubstr("\"times\":4"));
  history.come(kOil, "OIL", kBegin - kHour + 1, false);
  EXPECT_THAT(history.takeLines(kBegin - kHour + 1), HasSubstr("OIL"));
  EXPECT_THAT(shown(history), ElementsAre("DOOR 0-on x4", "OIL -3599-on")) << "in the order in which they came";
}

} // namespace
} // namespace rung::control
