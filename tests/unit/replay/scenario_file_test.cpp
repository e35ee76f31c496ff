// Recordings as scenarios: they pass with the same program, fail where it failed, and name what they lack.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ir/support/temporary_folder.h"
#include "tests/unit/replay/recorded_host.h"
#include "tests/unit/replay/recorded_scenario.h"
#include "tools/replay/growing_recording.h"
#include "tools/replay/past.h"
#include "tools/replay/scenario_file.h"
#include "tools/scenario/in_project.h"

namespace rung::replay {
namespace {

using ::testing::HasSubstr;

std::string problemsOf(const scenario::RunResult& result) {
  std::string problems = result.environment;
  for (const scenario::Problem& problem : result.problems) problems += scenario::textOf(problem) + "\n";
  return problems;
}

scenario::RunResult runText(const std::string& path, const std::string& text) {
  scenario::Scenario scenario = scenario::parse(path, text);
  scenario::takeProject(scenario);
  return scenario::run(scenario, {.engines = {compiler::EngineKind::Interp}});
}

std::unique_ptr<Past> open(const Recording& recording) {
  Result<std::unique_ptr<Past>> past = Past::open(recording, {.engine = compiler::EngineKind::Interp});
  EXPECT_TRUE(past.ok()) << past.error();
  return std::move(past).value();
}

// ---- the machines ------------------------------------------------------------------------------------------------

class Exports : public testing::TestWithParam<const char*> {};

TEST_P(Exports, PassWithTheSameProgram) {
  const std::string file = GetParam();
  const RecordedScenario recorded = recordedScenario(file);
  const auto past = open(recorded.recording);
  uint64_t to = past->contents().parts; // or where it was started again
  for (const Landmark& landmark : past->contents().landmarks)
    if (landmark.kind == Landmark::Kind::Start && landmark.part > past->firstPart()) to = std::min(to, landmark.part);
  ASSERT_GT(to, 100u);
  const std::string path = file.substr(0, file.rfind('/')) + "/exported.scn"; // which is not written
  const Result<ScenarioText> text = scenarioOf(*past, path, past->firstPart(), to);
  ASSERT_TRUE(text.ok()) << text.error();
  EXPECT_THAT(text.value().text, HasSubstr("\nset "));
  EXPECT_THAT(text.value().text, HasSubstr("\nexpect "));
  const scenario::RunResult result = runText(path, text.value().text);
  EXPECT_TRUE(result.passed) << problemsOf(result);
  EXPECT_FALSE(result.expectsNothing);
}

INSTANTIATE_TEST_SUITE_P(Machines, Exports,
                         testing::Values("examples/fanuc-vmc/door.scn", "examples/gsk-mill/tool-change.scn",
                                         "examples/nct-turning-centre/turret.scn"));

// What a CNC does besides writing signals is not in a scenario, which is said.
TEST(ExportLacks, NameWhatTheCncDid) {
  const std::pair<const char*, const char*> kCases[] = {
      {"examples/gsk-mill/window.scn", "answers to requests, which the simulated control gives in its own way: "},
      {"examples/nct-turning-centre/nc-program.scn", "answers to requests, "},
      {"examples/technol-machining-centre/door.scn", "runs of tasks by the control, such as those of a block"},
  };
  for (const auto& [file, lack] : kCases) {
    const RecordedScenario recorded = recordedScenario(file);
    const auto past = open(recorded.recording);
    const Result<ScenarioText> text =
        scenarioOf(*past, std::string(file) + ".scn", past->firstPart(), past->contents().parts);
    ASSERT_TRUE(text.ok()) << text.error();
    EXPECT_THAT(text.value().lacks, testing::Contains(HasSubstr(lack))) << file;
  }
}

// ---- faults ------------------------------------------------------------------------------------------------------

struct Faulting {
  const char* file;
  const char* input; // the program stops when it is 1
};

class Faults : public testing::TestWithParam<Faulting> {};

// On a host, as a machine has it.
TEST_P(Faults, AreThoseOfTheHost) {
  const TemporaryFolder folder;
  const HostProgram program = HostProgram::ofFile(GetParam().file);
  std::string fault;
  {
    rung::Instance instance(rung::Image::adopt(program.engine->program(), program.engine->context()));
    const std::string recording = folder / "recording";
    const rung_recording_options options{.size = sizeof options, .folder = recording.c_str()};
    ASSERT_EQ(rung_instance_record(instance.handle(), &options), RUNG_OK) << rung_error_text();
    uint8_t input = 0;
    instance.bindInput(GetParam().input, input);
    instance.powerOn(rung::Power::Cold);
    for (int i = 0; i < 7; ++i) EXPECT_EQ(instance.scan(), RUNG_OK);
    input = 1;
    for (int i = 0; i < 7; ++i) (void)instance.scan();
    ASSERT_EQ(rung_instance_record(instance.handle(), nullptr), RUNG_OK);
  }
  const Result<Recording> recording = readRecording(folder / "recording", {program.compiled});
  ASSERT_TRUE(recording.ok()) << recording.error();
  const auto past = open(recording.value());
  ASSERT_EQ(past->goTo(past->contents().parts), "");
  ASSERT_TRUE(past->instance().faulted());
  fault = past->instance().faultText();
  fault.resize(fault.find(" (")); // the scenario names the file from its folder
  const std::string path = folder / "fault.scn";
  const Result<ScenarioText> text = scenarioOf(*past, path, past->firstPart(), past->contents().parts);
  ASSERT_TRUE(text.ok()) << text.error();
  EXPECT_THAT(text.value().text, HasSubstr(fault));
  const scenario::RunResult result = runText(path, text.value().text);
  EXPECT_FALSE(result.passed);
  EXPECT_THAT(problemsOf(result), HasSubstr(fault)) << text.value().text;
  // The other way round: with the fault expected it passes.
  EXPECT_TRUE(runText(path, text.value().text + "expect_fault \"" + fault + "\"\n").passed);
}

INSTANTIATE_TEST_SUITE_P(Dialects, Faults,
                         testing::Values(Faulting{"tests/scenarios/fanuc/jmpb-loop.mne", "X10.0"},
                                         Faulting{"tests/scenarios/gsk/jmpb.pmc", "X10.1"},
                                         Faulting{"tests/scenarios/nct/timeout.lad", "ENDLESS"},
                                         Faulting{"tests/scenarios/technol/watchdog.plc", "GO"}));

// ---- what a scenario cannot have -----------------------------------------------------------------------------------

// Records the panel in memory, and gives the past to the test.
class Panel : public testing::Test {
protected:
  void record(const std::string& statements) {
    scenario::Scenario scenario = scenario::parse("examples/gsk-panel/x.scn", "program panel.lad\n" + statements);
    recorded_ = std::move(recordScenario(scenario, {.engines = {compiler::EngineKind::Interp}})).value();
    past_ = open(recorded_.recording);
  }
  Result<ScenarioText> exported(uint64_t from, uint64_t to) {
    return scenarioOf(*past_, "examples/gsk-panel/exported.scn", from, to);
  }
  RecordedScenario recorded_;
  std::unique_ptr<Past> past_;
};

TEST_F(Panel, ForcesAreStatements) {
  record("scan 2\nforce X_ESP 1\nscan 3\nset X_ESP 0\nscan 2\nunforce X_ESP\nscan 2\nexpect *ESP 1\n");
  const Result<ScenarioText> text = exported(0, past_->contents().parts);
  ASSERT_TRUE(text.ok()) << text.error();
  EXPECT_THAT(text.value().text, HasSubstr("\nforce X8.4 1\n"));
  EXPECT_THAT(text.value().text, HasSubstr("\nunforce X8.4\n"));
  EXPECT_THAT(text.value().text, Not(HasSubstr("set X8.4")));
  EXPECT_TRUE(runText("examples/gsk-panel/exported.scn", text.value().text).passed) << text.value().text;
}

TEST_F(Panel, AScenarioEndsWhereTheProgramIsStartedAgain) {
  record("set X_ESP 1\nscan 5\ncold_start\nset X_ESP 1\nscan 5\nexpect *ESP 1\n");
  const Result<ScenarioText> all = exported(0, past_->contents().parts);
  ASSERT_FALSE(all.ok());
  EXPECT_THAT(all.error(), HasSubstr("a scenario ends there (--to 5)"));
  EXPECT_TRUE(exported(0, 5).ok());
  EXPECT_TRUE(exported(5, past_->contents().parts).ok());
  const Result<ScenarioText> inside = exported(3, past_->contents().parts);
  ASSERT_FALSE(inside.ok());
}

TEST_F(Panel, WhereEventsAreMissingItEnds) {
  record("set X_ESP 1\nscan 5\nexpect *ESP 1\n");
  recorded_.recording.segments.push_back(recorded_.recording.segments[0]);
  recorded_.recording.segments[0].damage = "a block is damaged";
  past_ = open(recorded_.recording);
  const Result<ScenarioText> all = exported(0, past_->contents().parts);
  ASSERT_FALSE(all.ok());
  EXPECT_THAT(all.error(), HasSubstr("after scan 5 events are missing, so a scenario ends there (--to 5)"));
}

} // namespace
} // namespace rung::replay
