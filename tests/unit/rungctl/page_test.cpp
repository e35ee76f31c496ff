// The pages of rungctl top: whatever a host says and however small the terminal is, they fit.
#include "machine/rungctl/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "rtlib/text/controls.h"

namespace rung::rungctl {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

size_t columnsOf(const std::string& text) {
  return static_cast<size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }));
}

Look lookOf(size_t many) {
  Look look;
  look.log.emplace();
  look.status = {{"host", "plc"},          {"program", "mill\x1b[2J"},
                 {"dialect", "gsk"},       {"scanned", true},
                 {"scans", 124},           {"missed", 0},
                 {"us", 992000},           {"forced", 2},
                 {"clock", json::object()}};
  look.status["functions"] = {{"count", many}, {"lost", 0}, {"oldest", json::array()}};
  look.profile = {{"time_ns", 1000.0}, {"rungs", json::array()}};
  for (size_t i = 0; i < many; ++i) {
    look.profile["rungs"].push_back({{"rung", i},
                                     {"file", "/plc/\xc5\xbe\x65l.pmc"},
                                     {"line", i},
                                     {"title", std::string(300, 'x') + "\n\x07"},
                                     {"executions", i},
                                     {"time_ns", 2.5},
                                     {"max_ns", 9.0}});
    look.messages.push_back({{"kind", "message"}, {"came", 0}, {"text", "Zav\xc5\x99\x65te kryt"}, {"on", true}});
    look.log->push_back({{"kind", "fault"}, {"came", int64_t{1} << 62}, {"text", ""}});
    look.timers.push_back(
        {{"name", "TMRB " + std::to_string(i)}, {"unit", "us"}, {"elapsed", i}, {"file", ""}, {"line", i}});
    look.pins.push_back({.name = "pin-" + std::to_string(i), .value = "true", .former = "false", .uses = "X0.0"});
  }
  return look;
}

TEST(Page, HasTheSizeOfTheTerminal) {
  for (const size_t many : {0, 1, 7, 300}) {
    const Look look = lookOf(many);
    for (size_t section = 0; section < kSections; ++section)
      for (const size_t width : {1, 7, 80, 300})
        for (const size_t height : {1, 2, 3, 5, 24, 100})
          for (const size_t scrolled : {0, 1, 1000}) {
            const View view{.section = static_cast<Section>(section), .byLongest = scrolled != 0, .scrolled = scrolled};
            const std::vector<Line> page = pageOf(look, view, many == 7 ? "NO CONNECTION" : "", width, height);
            ASSERT_EQ(page.size(), height);
            for (const Line& line : page) {
              ASSERT_LE(columnsOf(line.text), width);
              ASSERT_FALSE(text::hasControls(line.text));
            }
          }
  }
}

TEST(Page, ShowsTheEndWhenItIsScrolledTooFar) {
  const std::vector<Line> page =
      pageOf(lookOf(300), {.section = Section::Pins, .byLongest = true, .scrolled = 5000}, "", 80, 24);
  EXPECT_THAT(page[22].text, HasSubstr("pin-99 ")) << "the last one by name";
}

TEST(Page, ThePinThatChangedLastIsFirst) {
  Look look = lookOf(3);
  look.pins[1].changedS = 5;
  look.pins[1].changes = 1;
  look.pins[2].changedS = 2;
  look.pins[2].changes = 4;
  look.pins[0].changedS = -1;
  const std::vector<Line> page = pageOf(look, {.section = Section::Pins}, "", 80, 24);
  const auto heading = std::ranges::find_if(page, [](const Line& line) { return line.text.starts_with("PINS"); });
  ASSERT_LT(heading, page.end() - 3);
  EXPECT_THAT(heading[1].text, HasSubstr("pin-2 "));
  EXPECT_THAT(heading[2].text, HasSubstr("pin-1 "));
  EXPECT_THAT(heading[3].text, HasSubstr("pin-0 "));
  EXPECT_EQ(heading[3].style, Style::Faint);
}

TEST(Page, TimersThatRun) {
  Look look = lookOf(0);
  EXPECT_THAT(wholeText(look), HasSubstr("\nno timer runs\n"));
  const json rung = {{"rung", 4}, {"file", "/plc/mill.pmc"}, {"line", 12}, {"title", "lamps"}};
  look.timers = {
      {{"name", "TMRB 12"}, {"unit", "us"}, {"elapsed", 12'304'000}, {"remaining", 27'696'000}, {"preset", 40'000'000}},
      {{"name", "TIM T1,50"}, {"unit", "runs"}, {"elapsed", 12}, {"remaining", 38}, {"preset", 50}},
      {{"name", "TIM T2"}, {"unit", "runs"}, {"elapsed", 3}}};
  for (json& timer : look.timers) timer.update(rung);
  EXPECT_THAT(wholeText(look),
              HasSubstr("\nTIMERS that run:  elapsed, preset, remaining, rung\n"
                        "TMRB 12                  12.304 s of     40.000 s     27.696 s left  mill.pmc:12  lamps\n"
                        "TIM T1,50                 12 runs of      50 runs      38 runs left  mill.pmc:12  lamps\n"
                        "TIM T2                     3 runs of            ?            ? left  mill.pmc:12  lamps\n"));
}

TEST(Page, WhatWaitsTooLongIsAnAlarm) {
  Look look = lookOf(0);
  json function = {{"function", "M"}, {"code", 6}, {"begun", true}, {"late", false}, {"us", 1'500'000}, {"since", 0}};
  look.status["functions"]["oldest"] = {function, function};
  look.status["functions"]["oldest"][1]["late"] = true;
  look.status["functions"]["count"] = 2;
  const std::vector<Line> page = pageOf(look, {.section = Section::Waiting}, "", 200, 24);
  const auto heading = std::ranges::find_if(page, [](const Line& line) { return line.text.starts_with("WAITING"); });
  ASSERT_LT(heading, page.end() - 2);
  EXPECT_THAT(heading[1].text, HasSubstr("M6: not finished by the program for 1.500 s, since "));
  EXPECT_EQ(heading[1].style, Style::Plain);
  EXPECT_EQ(heading[2].style, Style::Alarm);
}

TEST(Page, ALogThatWasNeverAskedForIsNotEmpty) {
  Look look = lookOf(0);
  look.log.reset();
  const std::vector<Line> page = pageOf(look, {.section = Section::Log}, "NO CONNECTION", 80, 24);
  EXPECT_TRUE(std::ranges::any_of(page, [](const Line& line) { return line.text.starts_with("not known: "); }));
}

TEST(Page, WithoutCountersItSaysHowToGetThem) {
  Look look = lookOf(0);
  look.profile = nullptr;
  EXPECT_THAT(wholeText(look), HasSubstr("rungc build --profile"));
  look.status.erase("clock");
  look.status["scan"] = {{"last_us", 12.34}, {"longest_us", 56.78}};
  EXPECT_THAT(wholeText(look), HasSubstr("\nscan: last 12.3 us, longest 56.8 us\n"));
}

TEST(Page, TextIsCutBetweenCharacters) {
  EXPECT_EQ(cutTo("\xc5\x99\xc5\x99\xc5\x99", 2), "\xc5\x99\xc5\x99");
  EXPECT_EQ(cutTo("ab", 2), "ab");
  EXPECT_EQ(cutTo("ab", 0), "");
}

} // namespace
} // namespace rung::rungctl
