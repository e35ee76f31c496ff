// Executes statements on a running program (see session.h).
#include "tools/scenario/session.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"
#include "tools/scenario/expectations.h"
#include "tools/scenario/names.h"
#include "tools/scenario/statements.h"
#include "tools/scenario/values.h"

namespace rung::scenario {
namespace {

constexpr const char* kNotReplaced = "no program has been replaced";

} // namespace

std::string scanText(uint64_t scan, int64_t us) {
  return fmt::format("scan {}, {:.3f} s", scan, static_cast<double>(us) / 1e6);
}

// ---- start ---------------------------------------------------------------------------------------------------------

void Session::addEngine(runtime::Engine& engine) {
  runs_.push_back(std::make_unique<EngineRun>(engine, folder_, clock_, controlRecorded_));
}

void Session::setCompiled(const compiler::GetCompiled& compiled) {
  for (const std::unique_ptr<EngineRun>& run : runs_) run->serve(compiled);
}

std::string Session::config(std::string_view key, std::string_view value) {
  for (const std::unique_ptr<EngineRun>& run : runs_)
    if (std::string problem = run->nc().config(key, value); !problem.empty()) return problem;
  return {};
}

std::string Session::connect(std::string_view source, std::string_view destination) {
  for (const std::unique_ptr<EngineRun>& run : runs_)
    if (std::string problem = run->nc().connect(source, destination); !problem.empty()) return problem;
  return {};
}

std::vector<sim::NcProblem> Session::start(nc::PowerOn kind) {
  for (const std::unique_ptr<EngineRun>& run : runs_) {
    run->powerOn(kind);
    // The ends of connections exist only once the program has started.
    if (auto problems = run->nc().connectionProblems(); !problems.empty()) return problems;
  }
  if (std::string text = difference(); !text.empty()) return {{RUNG_NONE, std::move(text)}};
  running_ = true;
  for (Observer* observer : observers_) observer->started(*this);
  return {};
}

void Session::addObserver(Observer& observer) {
  observers_.push_back(&observer);
  if (running_) observer.started(*this);
}

// ---- scans ---------------------------------------------------------------------------------------------------------

// The engines must agree after every scan.
std::string Session::difference() const {
  for (size_t i = 1; i < runs_.size(); ++i)
    if (const auto found = runtime::firstDifference(instance(), runs_[i]->instance(), nc::describe))
      return fmt::format("engines disagree (a bug in Rung): {} and {}: {}", runs_[0]->engineName(),
                         runs_[i]->engineName(), *found);
  return {};
}

std::string Session::advanceOnce(EngineRun::Advance how) {
  for (const std::unique_ptr<EngineRun>& run : runs_) run->advance(how);
  ++scans_;
  return afterScan();
}

std::string Session::afterScan() {
  std::string problem = difference();
  for (const std::unique_ptr<EngineRun>& run : runs_)
    if (RecordedNc* recorded = run->recordedNc(); recorded != nullptr && problem.empty())
      problem = prefixed(*run, recorded->takeUnused());
  shadows_.work();
  for (const std::unique_ptr<EngineRun>& run : runs_) {
    if (unattended_)
      run->ignore();
    else
      run->requests().take(run->instance());
  }
  for (Observer* observer : observers_) observer->scanned(*this);
  return problem;
}

runtime::RealTimeStats Session::runRealTime() {
  EngineRun& run = *runs_[0];
  run.nc().setRealTime();
  const auto slice = [&run] { run.advance(&sim::Machine::slice); };
  return runtime::runRealTime(run.instance(), slice, [&] {
    scans_ += run.instance().atListStart() ? 1 : 0;
    afterScan();
    return !run.instance().faulted() && !interrupted();
  });
}

std::string Session::advance(uint64_t count, EngineRun::Advance how) {
  for (uint64_t i = 0; i < count; ++i) {
    if (std::string problem = advanceOnce(how); !problem.empty()) return problem;
    if (interrupted()) return {};
  }
  return {};
}

std::string Session::runFor(const Statement& s) {
  const int64_t end = nowUs() + s.microseconds;
  while (nowUs() < end) {
    const int64_t before = nowUs();
    if (std::string problem = advanceOnce(&sim::Machine::scan); !problem.empty()) return problem;
    if (interrupted()) return {};
    // A stopped or faulted program may not advance the clock; time passes all the same.
    if (nowUs() != before) continue;
    for (const std::unique_ptr<EngineRun>& run : runs_) run->instance().advanceClock(end - before);
  }
  return {};
}

void Session::powerOn(nc::PowerOn kind) {
  for (const std::unique_ptr<EngineRun>& run : runs_) {
    if (kind == nc::PowerOn::Warm) run->machine().powerOff();
    run->powerOn(kind);
  }
}

std::string Session::restart(nc::PowerOn kind) try {
  powerOn(kind);
  faultExpected_ = false;
  for (Observer* observer : observers_) observer->started(*this);
  return {};
} catch (const rung::Error& error) {
  return error.what();
}

// ---- statements ----------------------------------------------------------------------------------------------------

std::string Session::prefixed(const EngineRun& run, const std::string& problem) const {
  return runs_.size() > 1 && !problem.empty() ? fmt::format("[{}] {}", run.engineName(), problem) : problem;
}

std::string Session::atScan(std::string problem) const {
  const std::string when =
      scans_ == 0 ? std::string(" (before the first scan)") : fmt::format(" ({})", scanText(scans_, nowUs()));
  problem.insert(std::min(problem.find('\n'), problem.size()), when);
  return problem;
}

std::string Session::unexpectedFault() const {
  if (faultExpected_) return {};
  for (const std::unique_ptr<EngineRun>& run : runs_)
    if (run->instance().faulted())
      return atScan(
          fmt::format("[{}] the program stopped with a fault: {}", run->engineName(), run->instance().faultText()));
  return {};
}

// The values of the first engine: they are the same in all.
std::string Session::print(const Statement& s) {
  const Result<std::string> line = printedLine(s, instance(), nc(), scans_);
  if (!line.ok()) return line.error();
  for (Observer* observer : observers_) observer->printed(line.value());
  return {};
}

Result<NextProgram> Session::makeProgram(const Statement& s) {
  if (!makeProgram_) return failure("no other program can be compiled here");
  Result<NextProgram> next = makeProgram_(s);
  if (!next.ok()) return next;
  const rung_program& program = next.value().engines[0]->program();
  if (std::string_view(program.dialect) != instance().program().dialect)
    return failure(fmt::format("{} has the dialect {}, but the running program has {}", program.name, program.dialect,
                               instance().program().dialect));
  return next;
}

std::string Session::shadow(const Statement& s) {
  shadows_.end();
  if (s.words.empty()) return {};
  const Result<NextProgram> next = makeProgram(s);
  return next.ok() ? shadows_.begin(runs_, next.value().engines) : next.error();
}

std::string Session::replace(const Statement& s) {
  const Result<NextProgram> next = makeProgram(s);
  if (!next.ok()) return next.error();
  ReplaceReport report;
  for (size_t i = 0; i < runs_.size(); ++i)
    if (const std::string problem = runs_[i]->replace(*next.value().engines[i], next.value().compiled, report);
        !problem.empty())
      return prefixed(*runs_[i], problem);
  shadows_.end();
  report_ = std::move(report);
  for (Observer* observer : observers_) observer->replaced(*this, next.value());
  return difference();
}

std::string Session::expectChange(const Statement& s) { return report_ ? report_->take(s.change) : kNotReplaced; }
std::string Session::expectNoChange(const Statement&) { return report_ ? report_->expectNone() : kNotReplaced; }

std::optional<Problem> Session::execute(const Statement& s) {
  const StatementInfo& info = StatementInfo::of(s);
  std::string problem;
  statement_ = &s;
  for (Observer* observer : observers_) observer->executing(*this, s);
  if (info.run != nullptr)
    problem = (this->*info.run)(s);
  else if (info.stage == Stage::Include)
    problem = "a file can be included by a scenario only";
  else
    problem = "the program has started; this statement belongs to the start of a scenario";
  statement_ = nullptr;
  if (problem.empty()) return std::nullopt;
  return problemAt(s, atScan(std::move(problem)));
}

std::string Session::set(const Statement& s) {
  return forRuns([&](EngineRun& run) { return setValue(run, s); });
}

std::string Session::scan(const Statement& s) { return advance(s.count, &sim::Machine::scan); }
std::string Session::fast(const Statement& s) { return advance(s.count, &sim::Machine::fast); }
std::string Session::slot(const Statement& s) {
  if (!nc().control().runsInSlots()) return "only the second level of a FANUC or GSK program is run in slots (8 ms)";
  return advance(s.count, &sim::Machine::slot);
}

std::string Session::slice(const Statement& s) { return advance(s.count, &sim::Machine::slice); }

std::string Session::expect(const Statement& s) {
  return forRuns([&](EngineRun& run) { return expectValue(run, s); });
}
std::string Session::expectRange(const Statement& s) {
  return forRuns([&](EngineRun& run) { return scenario::expectRange(run, s); });
}
std::string Session::expectMessage(const Statement& s) {
  return forRuns([&](EngineRun& run) { return scenario::expectMessage(run, s); });
}
std::string Session::expectLog(const Statement& s) {
  return forRuns([&](EngineRun& run) { return scenario::expectLog(run, s); });
}
std::string Session::expectFault(const Statement& s) {
  std::string problem = forRuns([&](EngineRun& run) { return scenario::expectFault(run, s); });
  faultExpected_ = faultExpected_ || problem.empty();
  return problem;
}

std::string Session::expectCall(const Statement& s) {
  return forRuns([&](EngineRun& run) { return run.requests().expectCall(run.instance(), s); });
}
std::string Session::expectNoCall(const Statement& s) {
  return forRuns([&](EngineRun& run) { return run.requests().expectNoCall(run.instance(), s); });
}
std::string Session::reply(const Statement& s) {
  return forRuns([&](EngineRun& run) { return run.requests().reply(run.instance(), s); });
}
std::string Session::prepare(const Statement& s) {
  return forRuns([&](EngineRun& run) { return run.requests().prepare(run.instance(), s); });
}

std::string Session::expectSent(const Statement& s) {
  return operate([&](auto& nc, auto&) { return nc.expectSent(s.name, arguments(s.keys)); });
}
std::string Session::block(const Statement& s) {
  if (s.name == "done") return operate([](auto& nc, auto& program) { return nc.blockDone(program); });
  return operate([&](auto& nc, auto& program) { return nc.blockStart(program, arguments(s.keys)); });
}
std::string Session::event(const Statement& s) {
  return operate([&](auto& nc, auto& program) { return nc.event(program, s.name, arguments(s.keys)); });
}
std::string Session::plc(const Statement& s) {
  return operate([&](auto& nc, auto& program) { return nc.plcCommand(program, s.name); });
}

std::string Session::within(const Statement& s) {
  return forRuns([&](EngineRun& run) -> std::string {
    RecordedNc* recorded = run.recordedNc();
    if (recorded == nullptr)
      return "the control is simulated: within needs a scenario that begins with control recorded";
    return recorded->take(run.instance(), s.number, s.name, s.words);
  });
}

std::string Session::coldStart(const Statement&) { return restart(nc::PowerOn::Cold); }
std::string Session::warmStart(const Statement&) { return restart(nc::PowerOn::Warm); }

std::string Session::snapshot(const Statement& s) {
  const rung_program& program = instance().program();
  Snapshot made{.forces = forces_.values(runs_),
                .report = report_,
                .faultExpected = faultExpected_,
                .code = program.code_hash,
                .layout = program.layout_hash};
  for (const std::unique_ptr<EngineRun>& run : runs_) {
    std::optional<EngineRun::Snapshot> ofRun = run->snapshot();
    if (!ofRun && instance().faulted())
      return "the program stopped within a scan: a snapshot is taken between two scans";
    if (!ofRun) return "a snapshot is taken between two scans, but this one has not ended: a scan statement ends it";
    made.runs.push_back(std::move(*ofRun));
  }
  snapshots_.insert_or_assign(s.name, std::move(made));
  return {};
}

std::string Session::goBack(const Snapshot& snapshot) {
  // A program that has stopped takes no forces.
  const bool stands = instance().faulted() || instance().stopped();
  if (stands && !snapshot.forces.empty()) powerOn(nc::PowerOn::Cold);
  if (std::string problem = forces_.restore(runs_, snapshot.forces); !problem.empty()) return problem;
  for (size_t i = 0; i < runs_.size(); ++i) runs_[i]->restore(snapshot.runs[i]);
  shadows_.end();
  report_ = snapshot.report;
  faultExpected_ = snapshot.faultExpected;
  for (Observer* observer : observers_) observer->restored(*this);
  return difference();
}

std::string Session::restore(const Statement& s) try {
  const auto found = snapshots_.find(s.name);
  if (found == snapshots_.end()) {
    std::string names;
    for (const auto& [name, snapshot] : snapshots_) names += (names.empty() ? "; there are: " : ", ") + name;
    return fmt::format("no snapshot '{}' has been taken{}", s.name, names);
  }
  const rung_program& program = instance().program();
  if (found->second.code != program.code_hash || found->second.layout != program.layout_hash)
    return fmt::format("the snapshot '{}' was taken of another program than the one that runs now", s.name);
  return goBack(found->second);
} catch (const rung::Error& error) {
  return error.what();
}

std::string Session::expectDifference(const Statement& s) { return shadows_.expectDifference(runs_, s.name); }
std::string Session::expectNoDifference(const Statement&) { return shadows_.expectNone(runs_); }

std::string Session::force(const Statement& s) { return forces_.set(runs_, s.name, s.value); }
std::string Session::unforce(const Statement& s) { return forces_.clear(runs_, s.words); }

} // namespace rung::scenario
