// The scenario runner: it fails where it should, with the line and what it read; and it notices a wrong engine.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

#include "ir/core/op_info.h"
#include "tests/support/saboteur.h"
#include "tools/scenario/runner.h"

namespace rung::scenario {
namespace {

using compiler::EngineKind;

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
  EXPECT_TRUE(problemOf("scan\nexpect 5101.00 1\n").starts_with("3: 5101.00 is 0, expected 1 (scan 1, 0.010 s)\n"));
}

TEST_F(ScenarioRunner, UnknownNamesAndKeysAreProblems) {
  EXPECT_NE(problemOf("set NOTHING 1\n").find("is not a name of this program"), std::string::npos);
  EXPECT_NE(problemOf("config colour 5\n").find("'colour' is not a configuration key of"), std::string::npos);
  EXPECT_NE(problemOf("connect A B\n").find("no connections"), std::string::npos);
  EXPECT_NE(problemOf("set 5100.00 7\n").find("a bit takes 0 or 1"), std::string::npos);
  EXPECT_NE(problemOf("slot\n").find("only the second level of a GSK program"), std::string::npos);
  EXPECT_NE(problemOf("event FIRE\n").find("unknown event"), std::string::npos);
  EXPECT_NE(problemOf("reply x=1\n").find("no request is pending"), std::string::npos);
  EXPECT_NE(problemOf("expect_call windr\n").find("no request is pending"), std::string::npos);
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

TEST_F(ScenarioRunner, OtherErrorsThanTheExpectedOnesAreProblems) {
  std::ofstream(folder_ / "lamp.lad")
      << "dialect nct\nmodule MAIN\nrung\n|--(5101.00)\nrung\n|--[NOWHERE]--(5101.01)\n";
  EXPECT_EQ(problemOf("expect_error 4 first-column-not-allowed\nexpect_error 6 undeclared-symbol\n"), "passed");
  const std::string problem = problemOf("expect_error 4 first-column-not-allowed\n");
  EXPECT_TRUE(problem.starts_with("2: there are errors that no expect_error names")) << problem;
  EXPECT_NE(problem.find("lamp.lad:6:5: error: "), std::string::npos) << problem;
  EXPECT_EQ(problem.find("first-column-not-allowed"), std::string::npos) << problem;
  EXPECT_EQ(problemOf("expect_error 4 first-column-not-allowed\nallow_errors\n"), "passed");
}

TEST_F(ScenarioRunner, AllowErrorsNeedsAnExpectedOne) {
  EXPECT_EQ(problemOf("allow_errors\nscan\n"),
            "2: allow_errors needs an expect_error: it allows others beside that one");
}

TEST_F(ScenarioRunner, MisspelledCodesAreSuggested) {
  EXPECT_NE(problemOf("expect_error undeclared-symbl\n").find("did you mean undeclared-symbol?"), std::string::npos);
}

TEST_F(ScenarioRunner, IncludedFilesAreThoseOfTheirFolder) {
  std::filesystem::create_directories(folder_ / "parts");
  std::ofstream(folder_ / "parts" / "start.part") << "program ../lamp.lad\nset 5100.00 1\nscan\nexpect 5101.00 off\n";
  const RunResult result =
      run(parse((folder_ / "t.scn").string(), "include parts/start.part\n"), {.engines = {EngineKind::Interp}});
  ASSERT_EQ(result.problems.size(), 1u) << result.environment;
  EXPECT_TRUE(result.problems[0].file.ends_with("parts/start.part")) << result.problems[0].file;
  EXPECT_EQ(result.problems[0].line, 4u);
}

TEST_F(ScenarioRunner, OnAndOffAreValuesOfBits) {
  EXPECT_EQ(problemOf("set 5100.00 on\nscan\nexpect 5101.00 true\nset 5100.00 off\nscan\nexpect 5101.00 false\n"),
            "passed");
  EXPECT_TRUE(problemOf("scan\nexpect 5101.00 on\n").starts_with("3: 5101.00 is 0, expected on (scan 1, 0.010 s)\n"));
  EXPECT_NE(problemOf("set 5200 on\n").find("this name is not a bit, so it cannot be on"), std::string::npos);
  EXPECT_NE(problemOf("expect 5200 off\n").find("5200 is not a bit, so it cannot be off: it is 0"), std::string::npos);
}

TEST_F(ScenarioRunner, PrintsValuesAndTexts) {
  RunOptions options;
  options.engines = {EngineKind::Interp, EngineKind::Jit};
  const RunResult result =
      runText("print 5101.00\nset 5100.00 1\nset 5200 300\nscan 2\nprint \"two scans\" 5101.00 5200\n", options);
  ASSERT_TRUE(result.passed) << result.environment;
  ASSERT_EQ(result.printed.size(), 2u);
  EXPECT_NE(result.printed[0].find(" ms, scan 0: 5101.00 = 0"), std::string::npos) << result.printed[0];
  EXPECT_NE(result.printed[1].find(" ms, scan 2: two scans, 5101.00 = 1, 5200 = 300 (0x12C)"), std::string::npos)
      << result.printed[1];
}

TEST_F(ScenarioRunner, AllThatIsWrongIsReportedAtOnceByLine) {
  const RunResult result = runText("wait 2s\nset NOTHING 1\nscan x\nexpect NEITHER 1\nprint NOBODY 5200\n");
  std::vector<uint32_t> lines;
  for (const Problem& problem : result.problems) lines.push_back(problem.line);
  EXPECT_EQ(lines, (std::vector<uint32_t>{2, 3, 4, 5, 6}));
  EXPECT_EQ(result.scans, 0u);
}

TEST_F(ScenarioRunner, UnknownNamesAreReportedBeforeTheFirstScan) {
  const RunResult result = runText("scan\nexpect 5101.00 1\nset NOTHING 1\nexpect_range NEITHER 1 2\n");
  ASSERT_EQ(result.problems.size(), 2u);
  EXPECT_EQ(result.problems[0].line, 4u);
  EXPECT_EQ(result.problems[1].line, 5u);
}

TEST_F(ScenarioRunner, NothingIsSaidOfAProgramWhoseStartIsUnknown) {
  const RunResult result = runText("confg nc simulated\nset NOTHING 1\n");
  ASSERT_EQ(result.problems.size(), 1u);
  EXPECT_EQ(result.problems[0].line, 2u);
}

TEST_F(ScenarioRunner, ProgramsWithErrorsAreReportedWithTheMistakesOfTheScenario) {
  std::ofstream(folder_ / "lamp.lad") << "dialect nct\nmodule MAIN\nrung\n|--(5101.00)\n";
  const RunResult result = runText("wait 2s\n");
  ASSERT_EQ(result.problems.size(), 2u);
  EXPECT_NE(result.problems[0].message.find("first-column-not-allowed"), std::string::npos);
}

TEST_F(ScenarioRunner, AMisspelledNameIsSuggested) {
  std::ofstream(folder_ / "lamp.lad")
      << "dialect nct\nmodule MAIN\nsymbol PUMP 5101.00\nsymbol COUNT 5200\nrung\n|--[5100.00]--(PUMP)\n";
  EXPECT_EQ(problemOf("set PMUP 1\n"), "2: 'PMUP' is not a name of this program; did you mean PUMP?");
  EXPECT_EQ(problemOf("expect COUTN.03 1\n"), "2: 'COUTN.03' is not a name of this program; did you mean COUNT?");
  EXPECT_EQ(problemOf("set NOTHING 1\n"), "2: 'NOTHING' is not a name of this program");
}

TEST_F(ScenarioRunner, AScenarioThatExpectsNothingIsKnown) {
  RunOptions options;
  EXPECT_TRUE(runText("scan\n", options).expectsNothing);
  EXPECT_TRUE(runText("scan\n", options).passed);
  EXPECT_FALSE(runText("scan\nexpect 5101.00 0\n", options).expectsNothing);
  options.strict = true;
  EXPECT_FALSE(runText("scan\n", options).passed);
  EXPECT_TRUE(runText("scan\nexpect 5101.00 0\n", options).passed);
}

TEST_F(ScenarioRunner, NamesTheFilesThatItWasMadeOf) {
  std::ofstream(folder_ / "start.part") << "program lamp.lad\n";
  const std::string own = (folder_ / "t.scn").string();
  const RunResult result =
      run(parse(own, "include start.part\nscan\nexpect 5101.00 0\n"), {.engines = {EngineKind::Interp}});
  EXPECT_TRUE(result.passed);
  EXPECT_EQ(result.files,
            (std::vector<std::string>{own, (folder_ / "start.part").string(), (folder_ / "lamp.lad").string()}));
}

TEST_F(ScenarioRunner, ThreadsShareEngines) {
  EngineStore store;
  RunOptions options;
  options.engines = {EngineKind::Interp, EngineKind::Jit};
  options.store = &store;
  std::atomic<int> passed{0};
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i)
      threads.emplace_back([&] { passed += runText("set 5100.00 1\nscan 100\nexpect 5101.00 1\n", options).passed; });
  }
  EXPECT_EQ(passed, 8);
}

// The store keeps the JIT's code of the program as it is; the interpreter, which comes later, has the program with a
// wrong operation.
TEST_F(ScenarioRunner, AWrongEngineIsCaughtThoughTheScenarioExpectsNothing) {
  RunOptions options;
  options.engines = {EngineKind::Interp, EngineKind::Jit};
  EXPECT_TRUE(runText("set 5100.00 1\nscan\n", options).passed);
  EngineStore store;
  options.store = &store;
  options.engines = {EngineKind::Jit};
  options.started = [](Session&, const compiler::Compiled& compiled) {
    ir::sabotage(*compiled.module, ir::OpCode::And);
    return std::string();
  };
  EXPECT_TRUE(runText("set 5100.00 1\nscan\n", options).passed);
  options.started = nullptr;
  options.engines = {EngineKind::Interp, EngineKind::Jit};
  const RunResult result = runText("set 5100.00 1\nscan\n", options);
  ASSERT_FALSE(result.passed);
  EXPECT_NE(result.problems[0].message.find("engines disagree: interp against jit"), std::string::npos)
      << result.problems[0].message;
  EXPECT_NE(result.problems[0].message.find("5101.00"), std::string::npos) << result.problems[0].message;
}

struct CountersOfTheLastScan final : Observer {
  void started(Session& session) override { starts += session.scans() == 0 ? 1 : 0; }
  void scanned(const Session& session) override {
    counters.assign(session.instance().profile().begin(), session.instance().profile().end());
  }
  int starts = 0;
  std::vector<rung_prof> counters;
};

TEST_F(ScenarioRunner, ObserversReadTheCountersOfAnInstrumentedProgram) {
  CountersOfTheLastScan observer;
  RunOptions options;
  options.engines = {EngineKind::Jit};
  options.instrument = true;
  options.started = [&](Session& session, const compiler::Compiled&) {
    session.addObserver(observer);
    return std::string();
  };
  ASSERT_TRUE(runText("scan 7\n", options).passed);
  EXPECT_EQ(observer.starts, 1);
  ASSERT_EQ(observer.counters.size(), 1u);
  EXPECT_EQ(observer.counters[0].count, 7u);
}

} // namespace
} // namespace rung::scenario
