// When messages came and went, in memory and as lines.
#include "machine/control/log_entries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rung::control {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int64_t kBegin = 1'700'000'000;
const LogEntries::Key kDoor{3, 0, 0};
const LogEntries::Key kOil{4, 0, 0};

// "DOOR 0-5", "DOOR 0-on", "fault 7"; "x2" where it came as often, "!" where the host ended meanwhile.
std::vector<std::string> shown(const LogEntries& log) {
  std::vector<std::string> lines;
  for (const LogEntry& entry : log.entries()) {
    std::string line = entry.text + " " + std::to_string(entry.cameS - kBegin);
    if (entry.wentS) line += "-" + std::to_string(*entry.wentS - kBegin);
    if (log.isOn(entry)) line += "-on";
    if (entry.times != 1) line += " x" + std::to_string(entry.times);
    lines.push_back(line + (entry.cut ? "!" : ""));
  }
  return lines;
}

TEST(LogEntries, MessagesComeAndGo) {
  LogEntries log;
  log.come(kDoor, "DOOR", kBegin, false);
  log.come(kOil, "OIL", kBegin + 1, false);
  log.happen({.text = "fault"}, kBegin + 2);
  EXPECT_EQ(log.go(kDoor, kBegin + 5), "DOOR");
  EXPECT_EQ(log.go(kDoor, kBegin + 6), "") << "it was not on";
  EXPECT_THAT(shown(log), ElementsAre("DOOR 0-5", "OIL 1-on", "fault 2"));
  ASSERT_EQ(log.shown().size(), 1u);
  EXPECT_EQ(log.shown()[0].text, "OIL");
  log.goAll(kBegin + 9);
  EXPECT_TRUE(log.shown().empty());
  EXPECT_THAT(shown(log), ElementsAre("DOOR 0-5", "OIL 1-9", "fault 2"));
}

TEST(LogEntries, OneThatIsOnAndIsShownAgainIsOneEntry) {
  LogEntries log;
  log.come(kDoor, "DOOR", kBegin, false);
  log.come(kDoor, "DOOR", kBegin + 1, false);
  EXPECT_THAT(shown(log), ElementsAre("DOOR 0-on"));
  log.come(kDoor, "DOOR of tool 7", kBegin + 2, false); // with another value
  EXPECT_THAT(shown(log), ElementsAre("DOOR 0-2", "DOOR of tool 7 2-on"));
}

TEST(LogEntries, AMessageThatFlickersIsCounted) {
  LogEntries log;
  for (int i = 0; i < 100; ++i) {
    log.come(kDoor, "DOOR", kBegin + i, i >= 5);
    log.go(kDoor, kBegin + i);
  }
  EXPECT_EQ(log.entries().size(), 5u);
  EXPECT_EQ(shown(log).back(), "DOOR 4-99 x96");
}

TEST(LogEntries, AMessageThatIsOnKeepsItsEntry) {
  LogEntries log;
  log.come(kDoor, "DOOR", kBegin, false);
  for (size_t i = 0; i < 2 * LogEntries::kMost; ++i) log.happen({.text = "event"}, kBegin + 1);
  EXPECT_EQ(log.entries().size(), LogEntries::kMost + 1);
  EXPECT_EQ(log.entries().front().text, "DOOR");
  ASSERT_EQ(log.shown().size(), 1u);
  EXPECT_EQ(log.shown()[0].cameS, kBegin);
  EXPECT_THAT(log.acknowledge(kBegin + 2), ElementsAre("DOOR"));
  EXPECT_EQ(log.entries().front().seenS, kBegin + 2);
  EXPECT_EQ(log.go(kDoor, kBegin + 3), "DOOR");
  EXPECT_EQ(log.entries().front().version, log.version()) << "clients that follow get the end, too";
  EXPECT_TRUE(log.shown().empty());
  log.takeAll();
  log.happen({.text = "event"}, kBegin + 4);
  log.happen({.text = "event"}, kBegin + 4);
  EXPECT_EQ(log.entries().size(), LogEntries::kMost);
  EXPECT_EQ(log.entries().front().text, "event");
}

// Without a disk nothing is written: all that happens must not add up.
TEST(LogEntries, WhatIsInMemoryIsBounded) {
  LogEntries log;
  constexpr int kMessages = LogEntries::kMostShown + 100;
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < kMessages; ++i) log.come({7, 0, i}, "many", kBegin, false);
    EXPECT_EQ(log.shown().size(), LogEntries::kMostShown);
    for (size_t i = 0; i < LogEntries::kMost; ++i) log.happen({.text = "event"}, kBegin);
    EXPECT_EQ(log.entries().size(), LogEntries::kMost + LogEntries::kMostShown);
    log.goAll(kBegin + 1);
  }
  for (size_t i = 0; i < LogEntries::kMostShown + 1; ++i) log.happen({.text = "event"}, kBegin);
  EXPECT_LE(log.entries().size(), LogEntries::kMost + LogEntries::kMostShown);
  const LogEntries::Lines lines = log.takeAll();
  EXPECT_EQ(static_cast<size_t>(std::ranges::count(lines.changed, '\n')), log.entries().size());
  EXPECT_EQ(lines.others, "");
}

TEST(LogEntries, AMessageThatSomebodyHasSeen) {
  LogEntries log;
  log.come(kDoor, "DOOR", kBegin, false);
  EXPECT_THAT(log.acknowledge(kBegin + 3), ElementsAre("DOOR"));
  EXPECT_EQ(log.entries()[0].seenS, kBegin + 3);
  EXPECT_TRUE(log.acknowledge(kBegin + 4).empty()) << "it has been seen";
  log.come(kOil, "OIL", kBegin + 5, false);
  EXPECT_THAT(log.acknowledge(kBegin + 6), ElementsAre("OIL"));
  log.go(kDoor, kBegin + 7);
  log.come(kDoor, "DOOR", kBegin + 8, true);
  EXPECT_THAT(log.acknowledge(kBegin + 9), ElementsAre("DOOR")) << "it has come again";
}

TEST(LogEntries, ALongTextIsCutBetweenCharacters) {
  LogEntries log;
  std::string text;
  while (text.size() < 70'000) text += "\xc5\x99";
  log.happen({.text = text}, kBegin);
  EXPECT_EQ(log.entries()[0].text.size(), 1996u + 3);
  EXPECT_TRUE(log.entries()[0].text.ends_with("\xc5\x99\xe2\x80\xa6"));
  log.happen({.text = std::string(LogEntries::kMostText, 'x')}, kBegin);
  EXPECT_EQ(log.entries()[1].text.size(), LogEntries::kMostText);
  log.come(kDoor, text, kBegin, false);
  log.come(kDoor, text, kBegin + 1, false);
  EXPECT_EQ(log.entries().size(), 3u) << "it is on already";
}

TEST(LogEntries, ChangesHaveVersions) {
  LogEntries log;
  log.come(kDoor, "DOOR", kBegin, false);
  const uint64_t before = log.version();
  log.happen({.text = "one"}, kBegin);
  EXPECT_GT(log.entries()[1].version, before);
  log.go(kDoor, kBegin + 1);
  EXPECT_EQ(log.entries()[0].version, log.version()) << "the last change";
}

// ---- lines

TEST(LogEntries, EveryMemberIsInTheLine) {
  LogEntries before;
  before.happen({.kind = LogKind::Set, .text = "set D8:2", .by = LogEntry::Person{"anna", 1000, 4711}}, kBegin);
  before.happen({.kind = LogKind::Fault, .text = "dead-loop", .place = LogEntry::Place{4, "mill.pmc", 12}}, kBegin);
  before.happen({.kind = LogKind::Fault, .text = "dead-loop", .place = LogEntry::Place{4, "mill.pmc", 12}}, kBegin,
                true);
  before.come(kDoor, "DOOR", kBegin, false);
  before.acknowledge(kBegin + 2);
  LogEntries after;
  EXPECT_EQ(after.read(before.takeAll().changed), 0u);
  ASSERT_EQ(after.entries().size(), 3u);
  const LogEntry& set = after.entries()[0];
  EXPECT_EQ(set.kind, LogKind::Set);
  EXPECT_EQ(textOf(set), "anna (user 1000, process 4711): set D8:2");
  const LogEntry& fault = after.entries()[1];
  EXPECT_EQ(fault.kind, LogKind::Fault);
  ASSERT_TRUE(fault.place);
  EXPECT_EQ(fault.place->rung, 4u);
  EXPECT_EQ(fault.place->file, "mill.pmc");
  EXPECT_EQ(fault.place->line, 12u);
  EXPECT_EQ(fault.times, 2u);
  EXPECT_EQ(after.entries()[2].seenS, kBegin + 2);
}

// A file of messages as hosts kept it before there were other entries.
TEST(LogEntries, LinesWithoutAKind) {
  LogEntries log;
  EXPECT_EQ(log.read("{\"came\":1700000000,\"key\":[3,0,0],\"n\":1,\"text\":\"DOOR\",\"went\":1700000004}\n"
                     "{\"came\":1700000005,\"n\":2,\"text\":\"the program has stopped\"}\n"),
            0u);
  EXPECT_EQ(log.entries()[0].kind, LogKind::Message);
  EXPECT_EQ(log.entries()[1].kind, LogKind::Report);
}

// In one turn, before anything is written.
TEST(LogEntries, TheEndOfAnOldMessageIsWritten) {
  LogEntries log;
  log.come(kDoor, "DOOR", kBegin, false);
  log.takeAll();
  for (size_t i = 0; i < LogEntries::kMost; ++i) log.happen({.text = "event"}, kBegin + 1);
  log.takeAll();
  log.go(kDoor, kBegin + 2);
  for (int i = 0; i < 10; ++i) log.happen({.text = "event"}, kBegin + 2);
  EXPECT_THAT(log.takeLines(kBegin + 2).changed, HasSubstr("\"went\":1700000002"));
  EXPECT_EQ(log.takeLost(), 0u);
}

TEST(LogEntries, LinesOfWhatIsOnAreTakenOnce) {
  LogEntries log;
  log.come(kDoor, "DOOR", kBegin, false);
  LogEntries::Lines lines = log.takeLines(kBegin);
  EXPECT_THAT(lines.changed, HasSubstr("DOOR"));
  EXPECT_EQ(lines.others, "");
  log.come(kOil, "OIL", kBegin + 1, false);
  lines = log.takeLines(kBegin + 1);
  EXPECT_THAT(lines.changed, AllOf(HasSubstr("OIL"), Not(HasSubstr("DOOR"))));
  EXPECT_THAT(lines.others, AllOf(HasSubstr("DOOR"), Not(HasSubstr("OIL"))));
}

TEST(LogEntries, WhatIsDroppedBeforeItIsWrittenIsCounted) {
  LogEntries log;
  for (size_t i = 0; i < LogEntries::kMost + 7; ++i) log.happen({.text = "event"}, kBegin);
  EXPECT_EQ(log.takeLost(), 7u);
  EXPECT_EQ(log.takeLost(), 0u);
}

TEST(LogEntries, LinesGiveBackWhatWasWritten) {
  LogEntries before;
  before.come(kDoor, "DOOR \"A\"\n\xff", kBegin, false);
  std::string text = before.takeLines(kBegin).changed;
  EXPECT_EQ(before.takeLines(kBegin).changed, "") << "nothing has changed";
  before.go(kDoor, kBegin + 4);
  before.happen({.text = "fault"}, kBegin + 5);
  before.come(kOil, "OIL", kBegin + 6, false);
  text += before.takeLines(kBegin + 6).changed;
  LogEntries after;
  EXPECT_EQ(after.read(text), 0u);
  EXPECT_THAT(shown(after), ElementsAre(HasSubstr("DOOR \"A\"\n"), "fault 5", "OIL 6!"));
  EXPECT_EQ(after.entries()[0].wentS, kBegin + 4);
  EXPECT_TRUE(after.shown().empty()) << "the host has ended: none is on";
  after.happen({.text = "begun"}, kBegin + 20);
  EXPECT_TRUE(after.isNew(after.entries().back()));
  EXPECT_FALSE(after.isNew(after.entries().front()));
  EXPECT_EQ(after.entries().back().number, 4u);
}

TEST(LogEntries, ARegularEndSaysUntilWhenTheyWereOn) {
  LogEntries before;
  before.come(kDoor, "DOOR", kBegin, false);
  before.end(kBegin + 8);
  LogEntries after;
  EXPECT_EQ(after.read(before.takeAll().changed), 0u);
  EXPECT_THAT(shown(after), ElementsAre("DOOR 0-8!"));
}

TEST(LogEntries, DamagedLinesAreLeftOut) {
  LogEntries before;
  before.happen({.text = "one"}, kBegin);
  before.happen({.text = "two"}, kBegin + 1);
  const std::string good = before.takeAll().changed;
  const std::string torn = good.substr(0, good.size() - 5);
  LogEntries after;
  EXPECT_EQ(after.read(torn), 1u);
  EXPECT_THAT(shown(after), ElementsAre("one 0"));
  LogEntries other;
  EXPECT_EQ(other.read("\xff\n[]\n5\n{\"n\":-1}\n{\"n\":1,\"came\":\"x\",\"text\":5}\n{\"n\":1}\n"
                       "{\"n\":0,\"came\":1,\"text\":\"\"}\n{\"n\":18446744073709551615,\"came\":1,\"text\":\"\"}\n" +
                       good),
            8u);
  EXPECT_THAT(shown(other), ElementsAre("one 0", "two 1"));
}

// A message of each scan must not wear the disk out, nor push the others out of the file.
TEST(LogEntries, WhatChangesAllTheTimeIsWrittenNowAndThen) {
  LogEntries log;
  size_t lines = 0;
  constexpr int kSeconds = 100;
  for (int i = 0; i < kSeconds * 100; ++i) {
    const int64_t now = kBegin + i / 100;
    log.come(kDoor, "DOOR", now, i >= 5);
    log.go(kDoor, now);
    const std::string text = log.takeLines(now).changed;
    lines += static_cast<size_t>(std::ranges::count(text, '\n'));
  }
  EXPECT_LT(lines, 40u);
  const std::string text = log.takeLines(kBegin + kSeconds + LogEntries::kPauseS).changed;
  EXPECT_THAT(text, HasSubstr("\"times\":9996")) << "what it was at last is written, too";
  EXPECT_EQ(log.takeLines(kBegin + 1000).changed, "");
}

TEST(LogEntries, AFloodOfTextsIsLimited) {
  LogEntries log;
  for (int i = 0; i < 500; ++i) log.happen({.text = "event " + std::to_string(i)}, kBegin);
  const std::string first = log.takeLines(kBegin).changed;
  EXPECT_EQ(static_cast<uint32_t>(std::ranges::count(first, '\n')), LogEntries::kMostLines);
  EXPECT_EQ(log.takeLines(kBegin).changed, "");
  EXPECT_EQ(static_cast<uint32_t>(std::ranges::count(log.takeLines(kBegin + 1).changed, '\n')), LogEntries::kMostLines)
      << "the next second";
}

// Somebody sets the clock, or it had no battery.
TEST(LogEntries, AClockThatIsSetBackHoldsUpNoLine) {
  constexpr int64_t kHour = 3600;
  LogEntries log;
  for (int i = 0; i < 3; ++i) { // it has had its lines
    log.come(kDoor, "DOOR", kBegin, i != 0);
    log.takeLines(kBegin);
    log.go(kDoor, kBegin);
    log.takeLines(kBegin);
  }
  log.come(kDoor, "DOOR", kBegin - kHour, true);
  EXPECT_THAT(log.takeLines(kBegin - kHour).changed, HasSubstr("\"times\":4"));
  log.come(kOil, "OIL", kBegin - kHour + 1, false);
  EXPECT_THAT(log.takeLines(kBegin - kHour + 1).changed, HasSubstr("OIL"));
  EXPECT_THAT(shown(log), ElementsAre("DOOR 0-on x4", "OIL -3599-on")) << "in the order in which they came";
}

} // namespace
} // namespace rung::control
