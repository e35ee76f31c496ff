// The scenario runner: it fails where it should, with the line and what it read; and it notices a wrong engine.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "tools/scenario/runner.h"

namespace rung::scenario {
namespace {

using driver::EngineKind;

constexpr const char* kLamp = R"(dialect nct
module MAIN

rung
|--[5100.00]--[/5100.01]--(5101.00)
)";

class ScenarioRunner : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("rung_scenario_test" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "lamp.lad") << kLamp;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  RunResult runText(const std::string& text, RunOptions options = {}) {
    if (options.engines.empty()) options.engines = {EngineKind::Interp};
    return run(parse((folder_ / "t.scn").string(), "program lamp.lad\n" + text), options);
  }
  std::string problemOf(const std::string& text) {
    const RunResult result = runText(text);
    return result.problems.empty() ? "passed"
                                   : std::to_string(result.problems[0].line) + ": " + result.problems[0].message;
  }

  std::filesystem::path folder_;
};

TEST_F(ScenarioRunner, PassesAndCountsScans) {
  const RunResult result =
      runText("set 5100.00 1\nscan 3\nexpect 5101.00 1\nset 5100.01 1\nrun 20ms\nexpect 5101.00 0\n");
  EXPECT_TRUE(result.passed) << (result.problems.empty() ? result.environment : result.problems[0].message);
  EXPECT_EQ(result.scans, 5u);
}

TEST_F(ScenarioRunner, SaysWhatItRead) {
  EXPECT_EQ(problemOf("scan\nexpect 5101.00 1\n"), "3: 5101.00 is 0, expected 1");
}

TEST_F(ScenarioRunner, UnknownNamesAndKeysAreProblems) {
  EXPECT_NE(problemOf("set NOTHING 1\n").find("no name of this program"), std::string::npos);
  EXPECT_NE(problemOf("config colour 5\n").find("unknown configuration key"), std::string::npos);
  EXPECT_NE(problemOf("connect A B\n").find("no connections"), std::string::npos);
  EXPECT_NE(problemOf("set 5100.00 7\n").find("a bit takes 0 or 1"), std::string::npos);
  EXPECT_NE(problemOf("slot\n").find("only the second level of a GSK program"), std::string::npos);
  EXPECT_NE(problemOf("event FIRE\n").find("unknown event"), std::string::npos);
  EXPECT_NE(problemOf("reply x=1\n").find("no request is pending"), std::string::npos);
  EXPECT_NE(problemOf("expect_call windr\n").find("no request waits"), std::string::npos);
  EXPECT_NE(problemOf("expect_fault dead-loop\n").find("the program runs"), std::string::npos);
  EXPECT_NE(problemOf("expect_message 5\n").find("not displayed"), std::string::npos);
  EXPECT_NE(problemOf("expect_log text\n").find("no log entry"), std::string::npos);
}

TEST_F(ScenarioRunner, ExpectedDiagnosticsMustBeReported) {
  std::ofstream(folder_ / "bad.lad") << "dialect nct\nmodule MAIN\nrung\n|--(5101.00)\n";
  const auto check = [&](const std::string& text) {
    return run(parse((folder_ / "t.scn").string(), "program bad.lad\n" + text),
               {.engines = {EngineKind::Interp}, .engine = {}, .programs = {}});
  };
  EXPECT_TRUE(check("expect_error 4 first-column-not-allowed\n").passed);
  EXPECT_FALSE(check("expect_error 3 first-column-not-allowed\n").passed);
  EXPECT_FALSE(check("expect_error dangling-wire\n").passed);
  EXPECT_FALSE(check("expect_error no-such-code\n").passed);
  EXPECT_FALSE(check("scan\n").passed) << "a program with errors cannot run";
}

TEST_F(ScenarioRunner, AWrongEngineIsCaughtThoughTheScenarioExpectsNothing) {
  RunOptions options;
  options.engines = {EngineKind::Interp, EngineKind::Jit};
  EXPECT_TRUE(runText("set 5100.00 1\nscan\n", options).passed);
  options.engine.sabotage = ir::OpCode::And;
  const RunResult result = runText("set 5100.00 1\nscan\n", options);
  ASSERT_FALSE(result.passed);
  EXPECT_NE(result.problems[0].message.find("engines disagree after scan 1: interp against jit"), std::string::npos)
      << result.problems[0].message;
  EXPECT_NE(result.problems[0].message.find("5101.00"), std::string::npos) << result.problems[0].message;
}

TEST_F(ScenarioRunner, ProfilesEveryRung) {
  RunOptions options;
  options.engines = {EngineKind::Jit};
  options.instrument = true;
  const RunResult result = runText("scan 7\n", options);
  ASSERT_TRUE(result.passed);
  ASSERT_EQ(result.profile.rows.size(), 1u);
  EXPECT_EQ(result.profile.rows[0].executions, 7u);
  EXPECT_EQ(result.profile.rows[0].line, 4u);
}

} // namespace
} // namespace rung::scenario
