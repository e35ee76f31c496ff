// The scenario parser: every statement, every mistake with its line.
#include <gtest/gtest.h>

#include "tools/scenario/scenario.h"

namespace rung::scenario {
namespace {

Statement only(const std::string& line) {
  const Scenario scenario = parse("t.scn", "program a.lad\n" + line + "\n");
  EXPECT_TRUE(scenario.problems.empty()) << line << ": "
                                         << (scenario.problems.empty() ? "" : scenario.problems[0].message);
  return scenario.statements.size() == 2 ? scenario.statements[1] : Statement{};
}

std::string problemOf(const std::string& line) {
  const Scenario scenario = parse("t.scn", "program a.lad\n" + line + "\n");
  if (scenario.problems.size() != 1) return "no problem";
  EXPECT_EQ(scenario.problems[0].line, 2u);
  return scenario.problems[0].message;
}

TEST(ScenarioParser, ValuesOfAllKinds) {
  EXPECT_EQ(only("set D10 -25").value.integer, -25);
  EXPECT_EQ(only("set D10 0x1F").value.integer, 31);
  EXPECT_EQ(only("set D10 -0x10").value.integer, -16);
  EXPECT_EQ(only("set F 1.5").value.kind, ValueKind::Real);
  EXPECT_EQ(only("set F -2e3").value.real, -2000.0);
  EXPECT_EQ(only("set T \"a # b\"").value.text, "a # b");
  EXPECT_EQ(only("set D 18446744073709551615").value.integer, -1);
}

TEST(ScenarioParser, AHashOpensACommentOnlyAtTheStartOfAWord) {
  const Statement s = only("set AN_PLCA,#1 1 # the second axis");
  EXPECT_EQ(s.name, "AN_PLCA,#1");
  EXPECT_EQ(s.value.integer, 1);
}

TEST(ScenarioParser, CountsAndTimes) {
  EXPECT_EQ(only("scan").count, 1u);
  EXPECT_EQ(only("fast 12").count, 12u);
  EXPECT_EQ(only("slot 0").count, 0u);
  EXPECT_EQ(only("run 250ms").microseconds, 250'000);
  EXPECT_EQ(only("period 1.5s").microseconds, 1'500'000);
}

TEST(ScenarioParser, Expectations) {
  const Statement near = only("expect POS ~ 1.5 0.01");
  EXPECT_TRUE(near.near);
  EXPECT_EQ(near.tolerance, 0.01);
  const Statement range = only("expect_range D0 -5 7");
  EXPECT_EQ(range.value.integer, -5);
  EXPECT_EQ(range.high.integer, 7);
  const Statement message = only("expect_message 20 off channel=1 text=\"two words\"");
  EXPECT_EQ(message.number, 20u);
  EXPECT_FALSE(message.on);
  ASSERT_EQ(message.keys.size(), 2u);
  EXPECT_EQ(message.keys[1].value.text, "two words");
  EXPECT_EQ(only("expect_error unbalanced-stack").number, 0u);
  const Statement error = only("expect_error 12 unbalanced-stack");
  EXPECT_EQ(error.number, 12u);
  EXPECT_EQ(error.name, "unbalanced-stack");
  EXPECT_EQ(only("expect_fault dead-loop").value.text, "dead-loop");
}

TEST(ScenarioParser, Services) {
  const Statement prepare = only("prepare windr function=1 -> end=0 data=5");
  EXPECT_EQ(prepare.name, "windr");
  ASSERT_EQ(prepare.keys.size(), 1u);
  ASSERT_EQ(prepare.results.size(), 2u);
  EXPECT_EQ(prepare.results[1].key, "data");
  EXPECT_EQ(only("reply DR=0").results.size(), 1u);
  EXPECT_EQ(only("expect_no_call").name, "");
  EXPECT_EQ(only("block start M03PI=1 PB06=0x03").kind, Kind::BlockStart);
  EXPECT_EQ(only("block done").kind, Kind::BlockDone);
  EXPECT_EQ(only("plc stop").name, "stop");
}

TEST(ScenarioParser, Mistakes) {
  EXPECT_NE(problemOf("frobnicate").find("unknown statement 'frobnicate'"), std::string::npos);
  EXPECT_NE(problemOf("set D10").find("expected a value"), std::string::npos);
  EXPECT_NE(problemOf("set D10 abc").find("'abc' is no value"), std::string::npos);
  EXPECT_NE(problemOf("scan -1").find("no number of runs"), std::string::npos);
  EXPECT_NE(problemOf("run 5").find("no duration"), std::string::npos);
  EXPECT_NE(problemOf("scan 1 2").find("unexpected '2'"), std::string::npos);
  EXPECT_NE(problemOf("set T \"open").find("not closed"), std::string::npos);
  EXPECT_NE(problemOf("plc jump").find("expected stop, start or clear"), std::string::npos);
  EXPECT_NE(problemOf("block").find("start or done"), std::string::npos);
  EXPECT_NE(problemOf("prepare windr function=1").find("->"), std::string::npos);
  EXPECT_NE(problemOf("event X Y").find("KEY=VALUE"), std::string::npos);
  EXPECT_NE(problemOf("period 0ms").find("longer than nothing"), std::string::npos);
}

TEST(ScenarioParser, WhatPreparesTheStartStandsInFrontOfTheFirstScan) {
  EXPECT_TRUE(parse("t.scn", "program a\nset A 1\nconfig k 1\nperiod 5ms\nscan\n").problems.empty());
  for (const char* late : {"config k 1", "connect A B", "period 5ms"}) {
    const Scenario scenario = parse("t.scn", std::string("program a\nscan\n") + late + "\n");
    ASSERT_EQ(scenario.problems.size(), 1u) << late;
    EXPECT_EQ(scenario.problems[0].line, 3u);
  }
}

TEST(ScenarioParser, SeveralMistakesAreReportedAtOnce) {
  EXPECT_EQ(parse("t.scn", "program a\nfoo\nscan x\nset A\n").problems.size(), 3u);
}

TEST(ScenarioParser, TheProgramComesFirst) {
  EXPECT_EQ(parse("t.scn", "scan\n").problems.size(), 1u);
  EXPECT_EQ(parse("t.scn", "").problems.size(), 1u);
}

} // namespace
} // namespace rung::scenario
