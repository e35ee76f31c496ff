// The scenario runner (see runner.h): compiles, starts a session, and executes the statements one by one.
#include "tools/scenario/runner.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "compiler/configuration.h"
#include "tools/scenario/compile_step.h"
#include "tools/scenario/names.h"
#include "tools/scenario/statements.h"

namespace rung::scenario {
namespace {

constexpr const char* kExpectsNothing =
    "the scenario expects nothing, so it passes whatever the program does; add an expect statement";

class Printer final : public Observer {
public:
  explicit Printer(std::vector<std::string>& lines) : lines_(lines) {}
  void scanned(const Session&) override {}
  void printed(const std::string& line) override { lines_.push_back(line); }

private:
  std::vector<std::string>& lines_;
};

class Runner {
public:
  Runner(const Scenario& scenario, const RunOptions& options)
      : scenario_(scenario), options_(options), session_(std::filesystem::path(scenario.path).parent_path().string()) {}

  RunResult run() {
    result_.files = scenario_.files;
    result_.problems = scenario_.problems;
    result_.expectsNothing = expectsNothing(scenario_);
    if (!scenario_.startUnknown) compileAndRun();
    sortProblems();
    result_.passed = result_.problems.empty() && result_.environment.empty();
    return std::move(result_);
  }

private:
  // The program of a replace or shadow statement.
  struct NamedProgram {
    const Statement* statement;
    std::vector<std::string> files;
    std::shared_ptr<StoredProgram> program;
    NextProgram next;
  };

  // All problems before the first scan are reported together.
  void compileAndRun() {
    const bool observed = options_.engine.observer != nullptr;
    const CompileSettings settings{.strict = options_.strict,
                                   .instrument = options_.instrument,
                                   .marks = observed || options_.marks,
                                   .optimise = !observed};
    CompileStep step = compileProgram(scenario_, options_.programs, settings);
    note(step);
    if (options_.strict && result_.expectsNothing) fail(scenario_.statements[0], kExpectsNothing);
    if (!step.program || !result_.environment.empty() || !step.problems.empty()) return;
    program_ = store().enter(std::move(*step.program));
    if (!compileNamed(settings) || !start()) return;
    std::vector<const rung_program*> next;
    for (const NamedProgram& named : named_)
      if (StatementInfo::of(*named.statement).program == OtherProgram::TakesOver)
        next.push_back(&named.next.engines[0]->program());
    add(result_.problems, unknownNames(scenario_, session_.instance().program(), next, session_.nc()));
    add(result_.problems, unfitValues(scenario_, session_.instance(), session_.nc()));
    if (!result_.problems.empty() || !observe(program_->compiled())) return;
    runStatements();
    if (options_.ended) options_.ended(session_);
  }

  void note(const CompileStep& step) {
    if (result_.environment.empty()) result_.environment = step.environment;
    add(result_.files, step.files);
    add(result_.problems, step.problems);
  }

  bool compileNamed(const CompileSettings& settings) {
    bool good = true;
    for (const Statement& s : scenario_.statements) {
      if (StatementInfo::of(s).program == OtherProgram::None || s.words.empty()) continue;
      const std::vector<std::string> files = programPaths(s);
      if (std::shared_ptr<StoredProgram> same = programOf(files)) {
        named_.push_back({&s, files, std::move(same), {}});
        continue;
      }
      CompileStep step = compileNext(scenario_, s, *program_->compiled().dialect, settings);
      note(step);
      good = good && step.program;
      if (step.program) named_.push_back({&s, files, store().enter(std::move(*step.program)), {}});
    }
    return good;
  }

  // The program of an earlier statement with the same files; null: none.
  std::shared_ptr<StoredProgram> programOf(const std::vector<std::string>& files) const {
    const auto found = std::ranges::find(named_, files, &NamedProgram::files);
    return found == named_.end() ? nullptr : found->program;
  }

  // Sorts by file and line; a problem in a file that is included twice is reported once.
  void sortProblems() {
    const auto place = [&](const Problem& p) {
      return std::pair(std::ranges::find(scenario_.files, p.file) - scenario_.files.begin(), p.line);
    };
    std::vector<Problem>& problems = result_.problems;
    std::ranges::stable_sort(problems, {}, place);
    const auto same = [](const Problem& a, const Problem& b) { return textOf(a) == textOf(b); };
    problems.erase(std::unique(problems.begin(), problems.end(), same), problems.end());
  }

  template <class T>
  static void add(std::vector<T>& to, const std::vector<T>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }

  void fail(const Statement& statement, std::string message) {
    result_.problems.push_back(problemAt(statement, std::move(message)));
  }

  EngineStore& store() { return options_.store != nullptr ? *options_.store : ownStore_; }

  // For a scenario that cannot run the program is only used to look names up.
  std::vector<compiler::EngineKind> engines() const {
    return scenario_.problems.empty() ? options_.engines : std::vector{compiler::EngineKind::Interp};
  }

  bool start() {
    for (const Statement& s : scenario_.statements)
      if (s.kind == Kind::Control) session_.setControlRecorded();
    for (compiler::EngineKind kind : engines()) {
      runtime::Engine* engine = engineOf(*program_, kind);
      if (engine == nullptr) return false;
      session_.addEngine(*engine);
      for (NamedProgram& named : named_) {
        named.next.engines.push_back(engineOf(*named.program, kind));
        if (named.next.engines.back() == nullptr) return false;
      }
    }
    session_.setCompiled(compiledOf(*program_));
    for (NamedProgram& named : named_) named.next.compiled = compiledOf(*named.program);
    session_.setMakeProgram([this](const Statement& s) -> Result<NextProgram> {
      return std::ranges::find(named_, &s, &NamedProgram::statement)->next;
    });
    return configure(*program_->compiled().dialect) && powerOn();
  }

  static compiler::GetCompiled compiledOf(const StoredProgram& program) {
    return [&program]() -> Result<const compiler::Compiled*> { return &program.compiled(); };
  }

  // Null if it cannot be made.
  runtime::Engine* engineOf(StoredProgram& program, compiler::EngineKind kind) {
    const Result<runtime::Engine*> engine = program.engine(kind, options_.engine);
    if (engine.ok()) return engine.value();
    result_.environment = engine.error();
    return nullptr;
  }

  std::string configure(const frontend::Dialect& dialect, const Statement& s) {
    if (nc::findConfigKey(dialect.configKeys, s.name) == nullptr) return compiler::unknownKeyText(dialect, s.name);
    return session_.config(s.name, s.value.text);
  }

  bool configure(const frontend::Dialect& dialect) {
    const size_t before = result_.problems.size();
    for (const Statement& s : scenario_.statements) {
      std::string problem;
      if (s.kind == Kind::Config && !readsKey(dialect, s.name)) problem = configure(dialect, s);
      if (s.kind == Kind::Connect) problem = session_.connect(s.words[0], s.words[1]);
      if (!problem.empty()) fail(s, problem);
    }
    return result_.problems.size() == before;
  }

  bool powerOn() {
    const std::vector<sim::NcProblem> problems = session_.start();
    std::vector<const Statement*> connects;
    for (const Statement& s : scenario_.statements)
      if (s.kind == Kind::Connect) connects.push_back(&s);
    for (const sim::NcProblem& problem : problems)
      fail(problem.connection < connects.size() ? *connects[problem.connection] : scenario_.statements[0],
           problem.text);
    return problems.empty();
  }

  bool observe(const compiler::Compiled& program) {
    session_.addObserver(printer_);
    if (options_.started) result_.environment = options_.started(session_, program);
    return result_.environment.empty();
  }

  void runStatements() {
    for (const Statement& s : scenario_.statements) {
      const StatementInfo& info = StatementInfo::of(s);
      if (info.stage != Stage::Run) continue;
      std::optional<Problem> problem = session_.execute(s);
      if (session_.scans() != result_.scans) lastSet_ = nullptr;
      result_.scans = session_.scans();
      if (info.sets) lastSet_ = &s;
      if (!problem) continue;
      if (info.expectsValue()) problem->message += unseenSet();
      if (info.expectsValue()) result_.unexpected = &s;
      result_.problems.push_back(std::move(*problem));
      return; // further problems would only repeat it
    }
    if (const std::string fault = session_.unexpectedFault(); !fault.empty()) fail(scenario_.statements.back(), fault);
  }

  // The problem that the program has not read the last value that the scenario set.
  std::string unseenSet() const {
    if (lastSet_ == nullptr) return {};
    return fmt::format("\n    no scan since `set {}` in line {}", lastSet_->name, lastSet_->line);
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  RunResult result_;
  const Statement* lastSet_ = nullptr;     // null: a scan has run since
  EngineStore ownStore_;                   // used if the options have none
  std::shared_ptr<StoredProgram> program_; // outlives the session
  std::vector<NamedProgram> named_;        // in the order of their statements
  Printer printer_{result_.printed};
  Session session_;
};

} // namespace

RunResult run(const Scenario& scenario, const RunOptions& options) { return Runner(scenario, options).run(); }

} // namespace rung::scenario
