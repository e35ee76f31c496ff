// The scenario parser: every statement, and mistakes with their file and line. What is said about a mistake is a golden
// (golden_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <unistd.h>

#include "tests/support/words.h"
#include "tools/scenario/scenario.h"
#include "tools/scenario/statements.h"

namespace rung::scenario {
namespace {

Statement only(const std::string& line) {
  const Scenario scenario = parse("t.scn", "program a.lad\n" + line + "\n");
  EXPECT_TRUE(scenario.problems.empty()) << line << ": "
                                         << (scenario.problems.empty() ? "" : scenario.problems[0].message);
  return scenario.statements.size() == 2 ? scenario.statements[1] : Statement{};
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

TEST(ScenarioParser, UnitsWhereAPersonWritesThem) {
  EXPECT_EQ(only("run 2 s").microseconds, 2'000'000);
  EXPECT_EQ(only("run 1.5 min").microseconds, 90'000'000);
  EXPECT_EQ(only("run 3min").microseconds, 180'000'000);
  EXPECT_EQ(only("run 500us").microseconds, 500);
  EXPECT_EQ(only("period 10 ms").microseconds, 10'000);
  EXPECT_EQ(only("scan 3 times").count, 3u);
  EXPECT_EQ(only("slot 4 slots").count, 4u);
  EXPECT_EQ(only("scan 1_000").count, 1000u);
  EXPECT_EQ(only("set D10 0b101").value.integer, 5);
  EXPECT_EQ(only("set D10 16#FF").value.integer, 255);
  EXPECT_EQ(only("set D10 2#1000_0001").value.integer, 129);
  EXPECT_EQ(only("set D10 -1_000").value.integer, -1000);
}

TEST(ScenarioParser, BitsAsPeopleWriteThem) {
  for (const char* on : {"on", "true", "ON", "True"}) {
    const Value value = only(std::string("set LAMP ") + on).value;
    EXPECT_EQ(value.kind, ValueKind::Int);
    EXPECT_TRUE(value.isBit);
    EXPECT_EQ(value.integer, 1) << on;
  }
  EXPECT_EQ(only("expect LAMP off").value.integer, 0);
  EXPECT_EQ(only("expect LAMP false").value.text, "false");
  EXPECT_EQ(only("event KEY STATE=on").keys[0].value.integer, 1);
  EXPECT_EQ(only("event KEY STATE=\"on\"").keys[0].value.kind, ValueKind::Text);
  EXPECT_FALSE(only("set LAMP 1").value.isBit);
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
  EXPECT_EQ(only("allow_errors").kind, Kind::AllowErrors);
}

TEST(ScenarioParser, PrintsNamesAndTexts) {
  const Statement print = only("print VALVE \"two words\" 5200");
  ASSERT_EQ(print.keys.size(), 3u);
  EXPECT_EQ(print.keys[0].key, "VALVE");
  EXPECT_EQ(print.keys[1].key, "");
  EXPECT_EQ(print.keys[1].value.text, "two words");
  EXPECT_EQ(print.keys[2].key, "5200");
}

TEST(ScenarioParser, Services) {
  const Statement prepare = only("prepare windr function=1 -> end=0 data=5");
  EXPECT_EQ(prepare.name, "windr");
  ASSERT_EQ(prepare.keys.size(), 1u);
  ASSERT_EQ(prepare.results.size(), 2u);
  EXPECT_EQ(prepare.results[1].key, "data");
  EXPECT_EQ(only("reply DR=0").results.size(), 1u);
  EXPECT_EQ(only("expect_no_call").name, "");
  EXPECT_EQ(only("block start M03PI=1 PB06=0x03").kind, Kind::Block);
  EXPECT_EQ(only("block done").name, "done");
  EXPECT_EQ(only("plc stop").name, "stop");
}

TEST(ScenarioParser, ChangesOfAReplacement) {
  const Statement replace = parseStatement("replace a.lad \"b c.lad\"").value();
  EXPECT_EQ(replace.kind, Kind::Replace);
  EXPECT_EQ(replace.words, (std::vector<std::string>{"a.lad", "b c.lad"}));
  const auto change = [](const std::string& line) { return parseStatement("expect_change " + line).value().change; };
  EXPECT_EQ(change("moved COUNT").kind, runtime::ChangeKind::Moved);
  EXPECT_EQ(change("moved COUNT").name, "COUNT");
  EXPECT_EQ(change("renamed LAMP BEACON").formerName, "LAMP");
  EXPECT_EQ(change("renamed LAMP BEACON").name, "BEACON");
  EXPECT_TRUE(change("new state \"MAIN/TON 1\"").slot);
  EXPECT_EQ(change("new state \"MAIN/TON 1\"").name, "MAIN/TON 1");
  EXPECT_FALSE(change("removed state").slot) << "a cell of this name";
  EXPECT_FALSE(parseStatement("expect_change kept A").ok());
}

TEST(ScenarioParser, OneLineAlone) {
  const Result<Statement> good = parseStatement("run 2 s # two");
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(good.value().kind, Kind::Run);
  EXPECT_EQ(good.value().line, 0u);
  EXPECT_FALSE(parseStatement("wait 2s").ok());
  EXPECT_FALSE(parseStatement("  # nothing").ok());
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ScenarioParser, ThePageHasEveryStatement) {
  const std::string page = contents("docs/scenario-format.md");
  ASSERT_FALSE(page.empty()) << "run from the root";
  for (const StatementInfo& info : StatementInfo::all())
    EXPECT_NE(page.find("`" + std::string(info.form.word)), std::string::npos) << info.form.word;
}

TEST(ScenarioParser, AScenarioHasEveryStatement) {
  std::set<Kind> seen;
  const auto note = [&](const std::filesystem::path& file) {
    std::istringstream lines(contents(file));
    for (std::string line; std::getline(lines, line);)
      if (const Result<Statement> statement = parseStatement(line); statement.ok()) seen.insert(statement.value().kind);
  };
  for (const char* folder : {"tests/scenarios", "tests/fuzz/scenario_seeds"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".scn") note(entry.path());
  for (const StatementInfo& info : StatementInfo::all()) EXPECT_TRUE(seen.contains(info.kind)) << info.form.word;
}

TEST(ScenarioParser, OnlyWhatTheStartNeedsMakesItUnknown) {
  const auto unknown = [](const std::string& line) { return parse("t.scn", "program a\n" + line + "\n").startUnknown; };
  EXPECT_FALSE(unknown("wait 2s"));
  EXPECT_FALSE(unknown("set X"));
  EXPECT_FALSE(unknown("set X 1"));
  EXPECT_TRUE(unknown("confg nc simulated"));
  EXPECT_TRUE(unknown("expect_eror 3 unbalanced-stack"));
  EXPECT_TRUE(unknown("include nowhere.part"));
  EXPECT_TRUE(unknown("period 5"));
}

class ScenarioFiles : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("rung_scenario_files" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_ / "parts");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  Scenario read(const std::string& name) {
    Result<Scenario> scenario = readScenario((folder_ / name).string());
    EXPECT_TRUE(scenario.ok());
    return scenario.ok() ? std::move(scenario).value() : Scenario{};
  }

  std::filesystem::path folder_;
};

TEST_F(ScenarioFiles, IncludedStatementsComeInPlaceWithTheirFile) {
  const std::string main = file("a.scn", "include parts/start.part\nscan\nexpect X 1\n");
  const std::string start = file("parts/start.part", "program ../a.lad\ninclude more.part\n");
  const std::string more = file("parts/more.part", "\nset X 1\n");
  const Scenario scenario = read("a.scn");
  ASSERT_TRUE(scenario.problems.empty()) << textOf(scenario.problems[0]);
  ASSERT_EQ(scenario.statements.size(), 4u);
  EXPECT_EQ(scenario.statements[0].file, start);
  EXPECT_EQ(scenario.statements[1].file, more);
  EXPECT_EQ(scenario.statements[1].line, 2u);
  EXPECT_EQ(scenario.statements[2].file, main);
}

TEST_F(ScenarioFiles, ProblemsNameTheFileThatHasThem) {
  file("a.scn", "program a.lad\ninclude b.part\nfoo\n");
  const std::string part = file("b.part", "scan\nbar\nconfig k 1\n");
  const Scenario scenario = read("a.scn");
  ASSERT_EQ(scenario.problems.size(), 3u);
  EXPECT_EQ(test::lacking(textOf(scenario.problems[0]), {part + ":2: ", "'bar'"}), "");
  EXPECT_EQ(test::lacking(textOf(scenario.problems[1]), {"b.part:3: ", "config"}), "");
  EXPECT_EQ(test::lacking(textOf(scenario.problems[2]), {"a.scn:3: ", "'foo'"}), "");
}

TEST_F(ScenarioFiles, WhatCannotBeIncluded) {
  file("a.scn", "program a.lad\ninclude b.part\ninclude nowhere.part\ninclude parts\ninclude a.lad\n");
  file("b.part", "include a.scn\n");
  file("a.lad", "dialect nct\n");
  const Scenario scenario = read("a.scn");
  ASSERT_EQ(scenario.problems.size(), 4u);
  EXPECT_EQ(test::lacking(textOf(scenario.problems[0]), {"b.part:1: ", "itself", "a.scn"}), "");
  EXPECT_EQ(test::lacking(textOf(scenario.problems[1]), {"a.scn:3: ", "nowhere.part"}), "");
  EXPECT_EQ(test::lacking(textOf(scenario.problems[2]), {"a.scn:4: ", "parts"}), "");
  EXPECT_EQ(test::lacking(textOf(scenario.problems[3]), {"a.lad", "program"}), "");
}

TEST_F(ScenarioFiles, FilesThatIncludeOthersManyTimesEnd) {
  for (int i = 0; i < 20; ++i) {
    const std::string next = "include " + std::to_string(i + 1) + ".part\n";
    file(std::to_string(i) + ".part", next + next);
  }
  file("20.part", "scan\n");
  file("a.scn", "program a.lad\ninclude 0.part\n");
  const Scenario scenario = read("a.scn");
  ASSERT_EQ(scenario.problems.size(), 1u);
  EXPECT_NE(scenario.problems[0].message.find("more than 1000 files"), std::string::npos);
}

TEST_F(ScenarioFiles, AProgramIsNotAScenario) {
  for (const char* name : {"a.lad", "a.pmc", "a.plc"}) {
    const Result<Scenario> scenario = readScenario(file(name, "x\ny\nz\n"));
    ASSERT_FALSE(scenario.ok()) << name;
    EXPECT_EQ(test::lacking(scenario.error(), {name, "program"}), "");
    EXPECT_EQ(scenario.error().find('\n'), std::string::npos);
  }
  EXPECT_FALSE(readScenario((folder_ / "missing.scn").string()).ok());
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
