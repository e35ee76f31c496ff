// A running program that executes one statement at a time, used by scenarios, the prompt and traces. With several
// engines, each statement goes to all of them, and after every scan the memory, messages, services and fault of each
// are compared with the first engine's.
//
//   Session session(folder);
//   session.addEngine(engine);            // one or several, all of one program
//   session.config("KEY", "VALUE");       // what the NC reads; the compiler's keys are the caller's
//   session.start();
//   if (auto problem = session.execute(statement)) …     // the session continues all the same
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/run/realtime.h"
#include "tools/scenario/engine_run.h"
#include "tools/scenario/forces.h"
#include "tools/scenario/scenario.h"
#include "tools/scenario/shadows.h"

namespace rung::scenario {

class Session;

// A program that replaces the running one, or runs beside it as a shadow.
struct NextProgram {
  std::vector<runtime::Engine*> engines; // one for each of the session's, in their order; must outlive the session
  compiler::GetCompiled compiled;        // its result must outlive the session
};

// "scan 12, 0.120 s".
std::string scanText(uint64_t scan, int64_t us);

class Observer {
public:
  virtual ~Observer() = default;
  // Called at the start and after every restart; for an observer that is added later, at once.
  virtual void started(Session& session) { (void)session; }
  // Called before a statement is executed.
  virtual void executing(const Session& session, const Statement& statement) { (void)session, (void)statement; }
  // Called after every scan, slot and run of the fast part, once the engines have been compared.
  virtual void scanned(const Session& session) = 0;
  // Called after another program has taken over.
  virtual void replaced(const Session& session, const NextProgram& next) { (void)session, (void)next; }
  // Called when the state of a snapshot has come back, and with it the clock of that moment.
  virtual void restored(const Session& session) { (void)session; }
  // Called with the line of a print statement.
  virtual void printed(const std::string& line) { (void)line; }
};

class Session {
public:
  // Files that the NC's configuration names are looked for in `folder`.
  explicit Session(std::string folder, sim::Clock clock = sim::Clock::Virtual)
      : folder_(std::move(folder)), clock_(clock) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Called before engines are added: no control is simulated, `within` says what it does.
  void setControlRecorded() { controlRecorded_ = true; }
  // Both are called before the start. The engines must outlive the session; config returns "" or what is wrong.
  void addEngine(runtime::Engine& engine);
  std::string config(std::string_view key, std::string_view value);
  std::string connect(std::string_view source, std::string_view destination);
  // Switches the program on. Throws rung::Error if retained memory cannot be loaded. Returns the problems: connections
  // whose ends do not exist, engines that disagree; with one of them the session has not started.
  std::vector<sim::NcProblem> start(nc::PowerOn kind = nc::PowerOn::Cold);

  // Compiles the programs of replace and shadow statements; the error says why there is no program. Without it these
  // statements are refused.
  using MakeProgram = std::function<Result<NextProgram>(const Statement& s)>;
  void setMakeProgram(MakeProgram make) { makeProgram_ = std::move(make); }

  // Sets the source of recompilation for the program that runs from the start.
  void setCompiled(const compiler::GetCompiled& compiled);

  // Executes one statement in all runs. The problem says what the statement expected or could not do, with the scan and
  // the time; statements that belong before the start are refused.
  std::optional<Problem> execute(const Statement& s);
  // Why the program stopped; "" if it runs or an expect_fault has named the fault.
  std::string unexpectedFault() const;

  // For a session without statements that check requests and the log: after every scan, requests are refused and the
  // log is dropped.
  void setUnattended() { unattended_ = true; }
  // Runs slice by slice on the computer's clock, with the first engine only, until the program stops or the interrupt
  // returns true.
  runtime::RealTimeStats runRealTime();

  // Those of the first engine.
  sim::Machine& machine() { return runs_[0]->machine(); }
  runtime::Instance& instance() { return runs_[0]->instance(); }
  const runtime::Instance& instance() const { return runs_[0]->instance(); }
  sim::SimulatedNc& nc() { return runs_[0]->nc(); }
  const sim::SimulatedNc& nc() const { return runs_[0]->nc(); }
  int64_t nowUs() const { return instance().nowUs(); }
  uint64_t scans() const { return scans_; } // includes slots and runs of the fast part
  // Report of the last replacement; empty before one.
  ReplaceReport report() const { return report_.value_or(ReplaceReport{}); }
  // Differences of the shadow from this program since the last call.
  std::vector<std::string> shadowNews() { return shadows_.news(); }
  // The active forces.
  const Forces::Values& forces() { return forces_.values(runs_); }
  // The statement that is being executed, for observers; otherwise null.
  const Statement* statement() const { return statement_; }

  // The observer must outlive the session.
  void addObserver(Observer& observer);
  // `interrupted` is called after every scan; true ends the statement, without a problem.
  void setInterrupt(std::function<bool()> interrupted) { interrupted_ = std::move(interrupted); }

private:
  // The problem, with scan and time at the end of its first line.
  std::string atScan(std::string problem) const;
  std::string advance(uint64_t count, EngineRun::Advance how);
  std::string advanceOnce(EngineRun::Advance how);
  std::string afterScan();
  std::string restart(nc::PowerOn kind);
  void powerOn(nc::PowerOn kind);
  struct Snapshot {
    std::vector<EngineRun::Snapshot> runs;
    Forces::Values forces;
    std::optional<ReplaceReport> report;
    bool faultExpected = false;
    uint64_t code = 0, layout = 0; // of the program
  };
  std::string goBack(const Snapshot& snapshot);
  Result<NextProgram> makeProgram(const Statement& s);
  std::string difference() const;
  bool interrupted() const { return interrupted_ && interrupted_(); }

  // Calls act(run) for every run; the first text that is not empty is the problem.
  template <class Act>
  std::string forRuns(Act act) {
    for (const std::unique_ptr<EngineRun>& run : runs_)
      if (const std::string problem = act(*run); !problem.empty()) return prefixed(*run, problem);
    return {};
  }
  template <class Act>
  std::string operate(Act act) {
    return forRuns([&](EngineRun& run) { return run.operate(act); });
  }
  std::string prefixed(const EngineRun& run, const std::string& problem) const;

  friend struct StatementInfo; // its rows refer to the functions that execute statements
  std::string set(const Statement& s);
  std::string scan(const Statement& s);
  std::string fast(const Statement& s);
  std::string slot(const Statement& s);
  std::string slice(const Statement& s);
  std::string runFor(const Statement& s);
  std::string expect(const Statement& s);
  std::string expectRange(const Statement& s);
  std::string expectMessage(const Statement& s);
  std::string expectLog(const Statement& s);
  std::string expectCall(const Statement& s);
  std::string expectNoCall(const Statement& s);
  std::string expectSent(const Statement& s);
  std::string reply(const Statement& s);
  std::string prepare(const Statement& s);
  std::string block(const Statement& s);
  std::string event(const Statement& s);
  std::string plc(const Statement& s);
  std::string within(const Statement& s);
  std::string coldStart(const Statement& s);
  std::string warmStart(const Statement& s);
  std::string snapshot(const Statement& s);
  std::string restore(const Statement& s);
  std::string expectFault(const Statement& s);
  std::string print(const Statement& s);
  std::string replace(const Statement& s);
  std::string expectChange(const Statement& s);
  std::string expectNoChange(const Statement& s);
  std::string shadow(const Statement& s);
  std::string expectDifference(const Statement& s);
  std::string expectNoDifference(const Statement& s);
  std::string force(const Statement& s);
  std::string unforce(const Statement& s);

  std::string folder_;
  sim::Clock clock_;
  std::vector<std::unique_ptr<EngineRun>> runs_;
  std::vector<Observer*> observers_;
  std::function<bool()> interrupted_;
  MakeProgram makeProgram_;
  std::optional<ReplaceReport> report_;
  Forces forces_;
  std::map<std::string, Snapshot> snapshots_; // by name
  Shadows shadows_;
  const Statement* statement_ = nullptr;
  uint64_t scans_ = 0;
  bool controlRecorded_ = false;
  bool running_ = false;
  bool faultExpected_ = false;
  bool unattended_ = false;
};

} // namespace rung::scenario
