// Going back: at a random scan of each scenario of the examples, and of each test with a simulated control, a snapshot
// is taken, the scenario runs to its end, goes back and runs to its end once more. Every scan must then end as it did
// before, with the same memory, messages and state of the control and of the machine, on two engines. And the state
// goes to another machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <random>

#include "compiler/engines.h"
#include "sim/machine.h"
#include "tools/scenario/compile_step.h"
#include "tools/scenario/runner.h"
#include "tools/scenario/statements.h"

namespace rung::scenario {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kSampleUs = 50'000; // between two comparisons of the whole state

struct Step {
  size_t statement = 0;
  int64_t beginUs = 0, endUs = 0;
  bool isWhole = false; // a scan has ended
  size_t digest = 0;    // of everything that the step left; between two samples only of the memory
};

class Steps final : public Observer {
public:
  explicit Steps(const Scenario& scenario) : scenario_(scenario) {}

  void started(Session& session) override {
    us_ = session.nowUs();
    session_ = &session;
  }
  void scanned(const Session& session) override {
    const auto statement = static_cast<size_t>(session.statement() - scenario_.statements.data());
    all.push_back({statement, us_, session.nowUs(), session.instance().atListStart(), digest()});
    us_ = session.nowUs();
  }
  void restored(const Session& session) override {
    backAt = all.size();
    us_ = session.nowUs();
  }

  std::vector<Step> all;
  size_t backAt = 0; // the number of steps before the restore

private:
  size_t digest() {
    std::string text(session_->instance().block().begin(), session_->instance().block().end());
    // Both ways have the same times.
    if (session_->nowUs() / kSampleUs != us_ / kSampleUs) {
      if (const auto state = session_->machine().instance().save()) text.append(state->begin(), state->end());
      for (const nc::ShownMessage& shown : session_->nc().control().messages(session_->instance())) text += shown.text;
    }
    return std::hash<std::string>()(text);
  }

  const Scenario& scenario_;
  Session* session_ = nullptr;
  int64_t us_ = 0;
};

using Engines = std::vector<compiler::EngineKind>;
const Engines kFast = {compiler::EngineKind::Jit}, kTwo = {compiler::EngineKind::Interp, compiler::EngineKind::Jit};

RunResult runOn(const Engines& engines, const Scenario& scenario, EngineStore& store, Steps& steps) {
  RunOptions options;
  options.engines = engines;
  options.store = &store;
  options.started = [&](Session& session, const compiler::Compiled&) {
    session.addObserver(steps);
    return std::string();
  };
  return run(scenario, options);
}

// The part of a statement up to this step, and the rest; without a rest, nothing.
std::pair<Statement, std::optional<Statement>> split(const Statement& s, const std::vector<Step>& steps, size_t at) {
  Statement first = s, rest = s;
  const auto begins = std::ranges::find(steps, steps[at].statement, &Step::statement);
  if (StatementInfo::of(s).advances == Advance::Time) {
    first.microseconds = steps[at].endUs - begins->beginUs;
    rest.microseconds -= first.microseconds;
    return {first, rest.microseconds > 0 ? std::optional(rest) : std::nullopt};
  }
  first.count = at - static_cast<size_t>(begins - steps.begin()) + 1;
  rest.count -= first.count;
  return {first, rest.count > 0 ? std::optional(rest) : std::nullopt};
}

// A snapshot after this step, and at the end everything after it once more.
Scenario goingBack(const Scenario& scenario, const std::vector<Step>& steps, size_t at) {
  const auto here = scenario.statements.begin() + static_cast<ptrdiff_t>(steps[at].statement);
  const auto [first, half] = split(*here, steps, at);
  std::vector<Statement> rest;
  if (half) rest.push_back(*half);
  std::copy_if(here + 1, scenario.statements.end(), std::back_inserter(rest),
               [](const Statement& s) { return StatementInfo::of(s).stage == Stage::Run; });
  Scenario made = scenario;
  made.statements.assign(scenario.statements.begin(), here);
  made.statements.push_back(first);
  made.statements.push_back(parseStatement("snapshot HERE").value());
  made.statements.insert(made.statements.end(), rest.begin(), rest.end());
  made.statements.push_back(parseStatement("restore HERE").value());
  made.statements.insert(made.statements.end(), rest.begin(), rest.end());
  std::copy_if(here + 1, scenario.statements.end(), std::back_inserter(made.statements),
               [](const Statement& s) { return StatementInfo::of(s).stage != Stage::Run; });
  return made;
}

// A step after which a snapshot can be taken and restored to the end: another program takes over only before it.
std::optional<size_t> randomStep(const Scenario& scenario, const std::vector<Step>& steps, std::mt19937& random) {
  const auto replaces = [](const Statement& s) { return StatementInfo::of(s).program != OtherProgram::None; };
  const auto last = std::find_if(scenario.statements.rbegin(), scenario.statements.rend(), replaces);
  const auto first = static_cast<size_t>(scenario.statements.rend() - last);
  std::vector<size_t> possible;
  for (size_t i = 0; i + 1 < steps.size(); ++i)
    if (steps[i].isWhole && steps[i].endUs > steps[i].beginUs && steps[i].statement >= first) possible.push_back(i);
  if (possible.empty()) return std::nullopt;
  return possible[random() % possible.size()];
}

std::string problemsOf(const RunResult& result) {
  std::string text = result.environment;
  for (const Problem& problem : result.problems) text += textOf(problem) + "\n";
  return text;
}

// False: the scenario does not run, or not for two scans.
bool repeats(const Scenario& scenario, EngineStore& store, std::mt19937& random) {
  Steps once(scenario);
  if (!runOn(kFast, scenario, store, once).passed) return false; // the examples have their own tests
  const std::optional<size_t> at = randomStep(scenario, once.all, random);
  if (!at) return false;
  const Scenario twice = goingBack(scenario, once.all, *at);
  Steps steps(twice);
  const RunResult result = runOn(kTwo, twice, store, steps);
  EXPECT_TRUE(result.passed) << scenario.path << ", step " << *at << ": " << problemsOf(result);
  const size_t again = steps.all.size() - steps.backAt;
  EXPECT_EQ(again, once.all.size() - *at - 1) << scenario.path;
  if (again > steps.backAt) return true;
  for (size_t i = 0; i < again; ++i)
    if (steps.all[steps.backAt - again + i].digest != steps.all[steps.backAt + i].digest) {
      ADD_FAILURE() << scenario.path << ": snapshot after step " << *at << ", " << i << " of " << again
                    << " steps are the same, then line "
                    << twice.statements[steps.all[steps.backAt + i].statement].line;
      break;
    }
  return true;
}

// Another machine of the same configuration, which gets the state of a session.
class Twin {
public:
  Twin(const Scenario& scenario, const compiler::Compiled& program)
      : engine_(std::move(compiler::makeEngine(compiler::EngineKind::Interp, program, {})).value()),
        machine_(engine_->program(), engine_->context(), sim::makeSimulatedNc(engine_->program().dialect)) {
    machine_.nc().setFolder(fs::path(scenario.path).parent_path().string());
    for (const Statement& s : scenario.statements) {
      if (s.kind == Kind::Config && !readsKey(*program.dialect, s.name))
        EXPECT_EQ(machine_.nc().config(s.name, s.value.text), "");
      if (s.kind == Kind::Connect) EXPECT_EQ(machine_.nc().connect(s.words[0], s.words[1]), "");
    }
    machine_.powerOn(nc::PowerOn::Cold);
  }

  void continues(const std::vector<uint8_t>& state) {
    machine_.instance().load(state);
    EXPECT_TRUE(machine_.instance().save() == state);
    machine_.scan();
  }
  // Whatever one byte says, the state is refused, or a program can run with it.
  void survives(std::vector<uint8_t> state, std::mt19937& random) {
    uint8_t& changed = state[random() % state.size()];
    changed = static_cast<uint8_t>(changed ^ (1u << random() % 8));
    if (random() % 4 == 0) state.resize(random() % state.size());
    machine_.powerOn(nc::PowerOn::Cold);
    if (rung_instance_load(machine_.instance().handle(), state.data(), state.size()) != RUNG_OK) ++refused;
    for (int i = 0; i < 3; ++i) machine_.scan();
    machine_.powerOn(nc::PowerOn::Warm);
  }
  uint32_t refused = 0;

private:
  std::unique_ptr<runtime::Engine> engine_;
  sim::Machine machine_;
};

struct LastState final : Observer {
  void started(Session& session) override { session_ = &session; }
  void scanned(const Session& session) override {
    if (session.scans() % 64 == 1 && session.instance().atListStart() && !session.instance().faulted())
      state = session_->machine().instance().save().value();
  }
  std::vector<uint8_t> state;
  Session* session_ = nullptr;
};

void handsOver(const char* path, std::mt19937& random) {
  const Result<Scenario> scenario = readScenario(path);
  ASSERT_TRUE(scenario.ok());
  LastState last;
  std::optional<Twin> twin;
  RunOptions options;
  options.engines = {compiler::EngineKind::Jit};
  options.started = [&](Session& session, const compiler::Compiled& program) {
    session.addObserver(last);
    twin.emplace(scenario.value(), program);
    return std::string();
  };
  EngineStore store; // keeps the program
  options.store = &store;
  const RunResult result = run(scenario.value(), options);
  EXPECT_TRUE(result.passed) << problemsOf(result);
  ASSERT_FALSE(last.state.empty());
  twin->continues(last.state);
  constexpr uint32_t kDamaged = 300;
  for (uint32_t i = 0; i < kDamaged; ++i) twin->survives(last.state, random);
  EXPECT_GT(twin->refused, kDamaged / 5) << "those that are cut off";
}

TEST(SimulatedState, GoesToAnotherMachine) {
  std::mt19937 random(1);
  for (const char* path :
       {"examples/fanuc-vmc/nc-program.scn", "examples/gsk-mill/nc-program.scn",
        "examples/nct-turning-centre/nc-program.scn", "examples/nct-turning-centre/nc-tools.scn",
        "examples/technol-machining-centre/part-program.scn", "examples/technol-magazine/tool-change.scn",
        "tests/scenarios/technol/can-units-panels.scn", "tests/scenarios/technol/device-manual-block.scn"}) {
    SCOPED_TRACE(path);
    handsOver(path, random);
  }
}

// The scenarios in a folder that do not go back themselves; of the tests of single instructions only those with a
// simulated control.
std::vector<Scenario> scenariosIn(const std::string& folder) {
  const auto isSimulated = [](const Statement& s) { return s.kind == Kind::Config && s.value.text == "simulated"; };
  const auto goesBack = [](const Statement& s) { return s.kind == Kind::Restore; };
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".scn") files.push_back(entry.path().string());
  std::ranges::sort(files);
  std::vector<Scenario> found;
  for (const std::string& file : files) {
    Result<Scenario> scenario = readScenario(file);
    EXPECT_TRUE(scenario.ok()) << file;
    const std::vector<Statement>& statements = scenario.value().statements;
    if (std::ranges::any_of(statements, goesBack)) continue;
    if (folder.starts_with("examples") || std::ranges::any_of(statements, isSimulated))
      found.push_back(std::move(scenario).value());
  }
  return found;
}

class GoingBack : public testing::TestWithParam<const char*> {};

TEST_P(GoingBack, RepeatsWhatHappened) {
  const std::vector<Scenario> scenarios = scenariosIn(GetParam());
  EngineStore store;
  std::mt19937 random(7);
  size_t repeated = 0;
  for (const Scenario& scenario : scenarios) repeated += repeats(scenario, store, random) ? 1 : 0;
  EXPECT_GE(repeated, scenarios.size() * 2 / 3);
}

INSTANTIATE_TEST_SUITE_P(Folders, GoingBack,
                         testing::Values("tests/scenarios/fanuc", "tests/scenarios/gsk", "tests/scenarios/nct",
                                         "tests/scenarios/technol", "examples/fanuc-vmc", "examples/gsk-mill",
                                         "examples/gsk-panel", "examples/nct-lathe", "examples/nct-turning-centre",
                                         "examples/technol-machining-centre", "examples/technol-magazine",
                                         "examples/technol-mill"),
                         [](const testing::TestParamInfo<const char*>& info) {
                           std::string name = info.param;
                           std::ranges::replace_if(name, [](char c) { return c == '-' || c == '/'; }, '_');
                           return name;
                         });

} // namespace
} // namespace rung::scenario
