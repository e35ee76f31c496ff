// Recordings as scenarios: they pass with the same program, fail where it failed, and name what they lack.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

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

// Every scenario of every example, by its path.
std::vector<std::string> scenariosOfExamples() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator("examples"))
    if (entry.path().extension() == ".scn") files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

// Scenarios whose recordings no scenario can repeat, and what the exporter says of them.
const std::map<std::string, std::string> kNotRepeated = {};

class Exports : public testing::TestWithParam<std::string> {};

// On the interpreter, whatever the simulated control did: within scans, too, and over restarts. If the program stopped
// with a fault, it stops with the same one.
TEST_P(Exports, DoTheSame) {
  const std::string& file = GetParam();
  const RecordedScenario recorded = recordedScenario(file);
  if (recorded.recording.segments.front().events.empty()) GTEST_SKIP() << "it runs no scan";
  const auto past = open(recorded.recording);
  const std::string path = file.substr(0, file.rfind('/')) + "/exported.scn"; // which is not written
  const Result<ScenarioText> text = scenarioOf(*past, path, past->firstPart(), past->contents().parts);
  ASSERT_TRUE(text.ok()) << text.error();
  const auto known = kNotRepeated.find(file);
  if (known == kNotRepeated.end())
    EXPECT_THAT(text.value().lacks, testing::IsEmpty());
  else
    EXPECT_THAT(text.value().lacks, testing::Contains(HasSubstr(known->second)));
  const scenario::RunResult result = runText(path, text.value().text);
  const std::string problems = problemsOf(result);
  EXPECT_EQ(result.passed, text.value().fault.empty() && known == kNotRepeated.end()) << problems;
  if (!text.value().fault.empty()) EXPECT_THAT(problems, HasSubstr(text.value().fault));
  EXPECT_EQ(result.environment, "");
}

INSTANTIATE_TEST_SUITE_P(Machines, Exports, testing::ValuesIn(scenariosOfExamples()));

TEST(Export, NamesSourcesThatAreNotHere) {
  const TemporaryFolder folder;
  std::filesystem::copy_file("examples/gsk-panel/panel.lad", folder / "gone.lad");
  scenario::Scenario scenario = scenario::parse(folder / "x.scn", "program gone.lad\nset X_ESP 1\nscan 3\n");
  const RecordedScenario recorded =
      std::move(recordScenario(scenario, {.engines = {compiler::EngineKind::Interp}})).value();
  const auto past = open(recorded.recording);
  std::filesystem::remove(folder / "gone.lad");
  const Result<ScenarioText> text = scenarioOf(*past, folder / "a.scn", 0, 3);
  ASSERT_TRUE(text.ok()) << text.error();
  EXPECT_THAT(text.value().lacks, testing::ElementsAre(HasSubstr("gone.lad' is not on this computer")));
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

TEST_F(Panel, AStartWithinItIsAStatement) {
  record("set X_ESP 1\nscan 5\ncold_start\nset X_ESP 1\nscan 5\nexpect *ESP 1\n");
  const Result<ScenarioText> all = exported(0, past_->contents().parts);
  ASSERT_TRUE(all.ok()) << all.error();
  EXPECT_THAT(all.value().text, HasSubstr("\ncold_start\n"));
  EXPECT_TRUE(runText("examples/gsk-panel/exported.scn", all.value().text).passed) << all.value().text;
}

TEST_F(Panel, ItMayBeginAnywhere) {
  record("set X_ESP 1\nscan 5\nset LIGHT 1\nscan 5\nset X_ESP 0\nscan 5\nexpect *ESP 0\n");
  const Result<ScenarioText> inside = exported(8, past_->contents().parts);
  ASSERT_TRUE(inside.ok()) << inside.error();
  EXPECT_THAT(inside.value().text, HasSubstr("\nwithin 0 clock 64000\n"));
  EXPECT_TRUE(runText("examples/gsk-panel/exported.scn", inside.value().text).passed) << inside.value().text;
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
