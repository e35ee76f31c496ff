// The scenario runner (see runner.h): compiles, starts a session, and gives it the statements one by one.
#include "tools/scenario/runner.h"

#include <filesystem>

#include "tools/scenario/compile_step.h"
#include "tools/scenario/session.h"

namespace rung::scenario {
namespace {

class Runner {
public:
  Runner(const Scenario& scenario, const RunOptions& options)
      : scenario_(scenario), options_(options), session_(std::filesystem::path(scenario.path).parent_path().string()) {}

  RunResult run() {
    CompileStep step = compileProgram(scenario_, options_.programs, options_.strict, options_.instrument);
    result_.environment = step.environment;
    result_.problems = step.problems;
    if (step.program && result_.environment.empty() && result_.problems.empty() &&
        start(store().enter(std::move(*step.program)))) {
      runStatements();
      if (options_.instrument) makeProfile();
    }
    result_.passed = result_.problems.empty() && result_.environment.empty();
    return std::move(result_);
  }

private:
  void fail(const Statement& statement, std::string message) {
    result_.problems.push_back({statement.line, std::move(message)});
  }

  EngineStore& store() { return options_.store != nullptr ? *options_.store : ownStore_; }

  bool start(StoredProgram& program) {
    for (driver::EngineKind kind : options_.engines) {
      Result<host::Engine*> engine = program.engine(kind, options_.engine);
      if (!engine.ok()) {
        result_.environment = engine.error();
        return false;
      }
      session_.addEngine(*engine.value());
    }
    return configure(*program.compiled().dialect) && powerOn();
  }

  bool configure(const frontend::Dialect& dialect) {
    for (const Statement& s : scenario_.statements) {
      std::string problem;
      if (s.kind == Kind::Config && !readsKey(dialect, s.name)) problem = session_.config(s.name, s.value.text);
      if (s.kind == Kind::Connect) problem = session_.connect(s.words[0], s.words[1]);
      if (problem.empty()) continue;
      fail(s, problem);
      return false;
    }
    return true;
  }

  bool powerOn() {
    const std::vector<nc::NcProblem> problems = session_.start();
    std::vector<const Statement*> connects;
    for (const Statement& s : scenario_.statements)
      if (s.kind == Kind::Connect) connects.push_back(&s);
    for (const nc::NcProblem& problem : problems)
      fail(problem.connection < connects.size() ? *connects[problem.connection] : scenario_.statements[0],
           problem.text);
    return problems.empty();
  }

  void runStatements() {
    for (const Statement& s : scenario_.statements) {
      if (belongsToStart(s.kind)) continue;
      std::optional<Problem> problem = session_.execute(s);
      result_.scans = session_.scans();
      if (!problem) continue;
      result_.problems.push_back(std::move(*problem));
      return; // what follows would only repeat it
    }
    if (const std::string fault = session_.unexpectedFault(); !fault.empty()) fail(scenario_.statements.back(), fault);
  }

  void makeProfile() {
    const host::Instance& instance = session_.instance();
    result_.profile = profile::makeReport(instance.program(), instance.profile(), profile::nsPerTick());
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  RunResult result_;
  EngineStore ownStore_; // when the options bring none; outlives the session
  Session session_;
};

} // namespace

RunResult run(const Scenario& scenario, const RunOptions& options) { return Runner(scenario, options).run(); }

} // namespace rung::scenario
