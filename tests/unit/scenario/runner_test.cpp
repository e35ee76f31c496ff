// The scenario runner: it fails where it should, and it notices a wrong engine. What it says is a golden
// (golden_test.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

#include "ir/core/op_info.h"
#include "tests/support/saboteur.h"
#include "tests/support/words.h"
#include "tools/replay/session_past.h"
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
    return replay::runAndExplain(parse((folder_ / "t.scn").string(), "program lamp.lad\n" + text), options);
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

// Nothing is simulated: a value is what statements say, at its turn within a scan.
TEST_F(ScenarioRunner, ARecordedControlDoesWhatIsWritten) {
  const std::string begin = "control recorded\n";
  EXPECT_TRUE(runText(begin + "within 0 set 5100.00 1\nscan\nexpect 5101.00 1\n").passed);
  EXPECT_TRUE(runText(begin + "set 5100.00 1\nwithin 1 set 5100.01 1\nslice 2\nexpect 5100.01 1\n").passed);
  EXPECT_TRUE(runText(begin + "plc stop\nset 5100.00 1\nscan\nexpect 5101.00 0\nplc start\nscan\n"
                              "expect 5101.00 1\n")
                  .passed);
  EXPECT_EQ(problemOf("within 0 set 5100.00 1\n"),
            "2: the control is simulated: within needs a scenario that begins with control recorded (before the first "
            "scan)");
  EXPECT_THAT(problemOf("control simulated\nscan\n"), testing::HasSubstr("expected recorded, found 'simulated'"));
  EXPECT_THAT(problemOf(begin + "within x set 5100.00 1\n"), testing::HasSubstr("'x' is not the number of a turn"));
  const std::pair<const char*, const char*> kCases[] = {
      {"0 put 5100.00 1", "expected set NAME BITS, memory SPACE BYTE VALUE, "},
      {"0 set NOWHERE 1", "'NOWHERE' is not a number or a bit of this program"},
      {"0 set 5100.00 on", "'on' is not a whole number"},
      {"0 memory NOWHERE 0 1", "this program has no byte 0 in a memory 'NOWHERE'"},
      {"0 state NOWHERE 1", "this program has no internal state 'NOWHERE'"},
      {"0 task NOWHERE", "this program has no task 'NOWHERE'"},
      {"0 reply 1 late", "expected done or error, found 'late'"},
      {"0 reply 1 done", "the program has made 0 requests since the start, so there is none with the number 1"},
  };
  for (const auto& [action, problem] : kCases)
    EXPECT_THAT(problemOf(begin + "within " + action + "\n"), testing::HasSubstr(problem)) << action;
  EXPECT_THAT(problemOf(begin + "within 99 set 5100.00 1\nscan\n"),
              testing::HasSubstr("the control did not get its turn 99"));
  EXPECT_THAT(problemOf(begin + "within 0 answer 1 done 5\nscan\n"),
              testing::HasSubstr("the program did not make request 1"));
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
  EXPECT_EQ(test::lacking(problem, {"2: ", "expect_error", "lamp.lad:6:5: error: "}), "");
  EXPECT_EQ(problem.find("first-column-not-allowed"), std::string::npos) << problem;
  EXPECT_EQ(problemOf("expect_error 4 first-column-not-allowed\nallow_errors\n"), "passed");
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
}

TEST_F(ScenarioRunner, PrintsValuesAndTexts) {
  RunOptions options;
  options.engines = {EngineKind::Interp, EngineKind::Jit};
  const RunResult result =
      runText("print 5101.00\nset 5100.00 1\nset 5200 300\nscan 2\nprint \"two scans\" 5101.00 5200\n", options);
  ASSERT_TRUE(result.passed) << result.environment;
  ASSERT_EQ(result.printed.size(), 2u);
  EXPECT_EQ(test::lacking(result.printed[0], {" ms, scan 0: 5101.00 = 0"}), "");
  EXPECT_EQ(test::lacking(result.printed[1], {" ms, scan 2: two scans, 5101.00 = 1, 5200 = 300 (0x12C)"}), "");
}

TEST_F(ScenarioRunner, ValuesAreExplainedFromTheRestoreOn) {
  EXPECT_EQ(
      test::lacking(problemOf("set 5100.00 1\nscan 2\nsnapshot ON\nscan\nrestore ON\nscan\nexpect 5101.00 0\n"),
                    {"5100.00 = 1, since scan 4, 0.030 s\n        as the program was started, or a state loaded\n",
                     "t.scn:6: restore ON"}),
      "");
}

TEST_F(ScenarioRunner, ASnapshotIsTakenBetweenScans) {
  const auto problemIn = [](const char* file, const char* text) {
    RunOptions options;
    options.engines = {EngineKind::Interp};
    const RunResult result = run(parse(file, text), options);
    return result.problems.empty() ? std::string("passed") : result.problems[0].message;
  };
  EXPECT_EQ(test::lacking(problemIn("tests/scenarios/gsk/typed.scn",
                                    "program binding.pmc\nperiod 24ms\nscan\nsnapshot A\nslot\nsnapshot B\n"),
                          {"a snapshot is taken between two scans, but this one has not ended", "(scan 2"}),
            "");
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
    ir::sabotage(*compiled.module, ir::findOp("and")->code);
    return std::string();
  };
  EXPECT_TRUE(runText("set 5100.00 1\nscan\n", options).passed);
  options.started = nullptr;
  options.engines = {EngineKind::Interp, EngineKind::Jit};
  const RunResult result = runText("set 5100.00 1\nscan\n", options);
  ASSERT_FALSE(result.passed);
  EXPECT_EQ(test::lacking(result.problems[0].message, {"engines disagree (a bug in Rung): interp and jit", "5101.00"}),
            "");
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
