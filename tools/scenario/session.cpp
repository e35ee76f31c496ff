// A running program that takes statements (see session.h).
#include "tools/scenario/session.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"
#include "tools/scenario/expectations.h"
#include "tools/scenario/names.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

std::string scanText(uint64_t scan, int64_t us) {
  return fmt::format("scan {}, {:.3f} s", scan, static_cast<double>(us) / 1e6);
}

bool belongsToStart(Kind kind) {
  switch (kind) {
  case Kind::Include:
  case Kind::Program:
  case Kind::Dialect:
  case Kind::Config:
  case Kind::Connect:
  case Kind::Period:
  case Kind::ExpectError:
  case Kind::ExpectWarning:
  case Kind::AllowErrors: return true;
  default: return false;
  }
}

// ---- start ---------------------------------------------------------------------------------------------------------

void Session::addEngine(runtime::Engine& engine) { lanes_.push_back(std::make_unique<Lane>(engine, folder_, clock_)); }

void Session::setCompiled(const compiler::GetCompiled& compiled) {
  for (const std::unique_ptr<Lane>& lane : lanes_) lane->serve(compiled);
}

std::string Session::config(std::string_view key, std::string_view value) {
  for (const std::unique_ptr<Lane>& lane : lanes_)
    if (std::string problem = lane->nc().config(key, value); !problem.empty()) return problem;
  return {};
}

std::string Session::connect(std::string_view source, std::string_view destination) {
  for (const std::unique_ptr<Lane>& lane : lanes_)
    if (std::string problem = lane->nc().connect(source, destination); !problem.empty()) return problem;
  return {};
}

std::vector<sim::NcProblem> Session::start(nc::PowerOn kind) {
  for (const std::unique_ptr<Lane>& lane : lanes_) {
    lane->powerOn(kind);
    // The ends of connections are known when the program has started.
    if (auto problems = lane->nc().connectionProblems(); !problems.empty()) return problems;
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
  for (size_t i = 1; i < lanes_.size(); ++i)
    if (const auto found = runtime::firstDifference(instance(), lanes_[i]->instance(), nc::describe))
      return fmt::format("engines disagree (a bug in Rung): {} and {}: {}", lanes_[0]->engineName(),
                         lanes_[i]->engineName(), *found);
  return {};
}

std::string Session::advanceOnce(Lane::Advance how) {
  for (const std::unique_ptr<Lane>& lane : lanes_) lane->advance(how);
  ++scans_;
  return afterScan();
}

std::string Session::afterScan() {
  std::string problem = difference();
  shadows_.work();
  for (const std::unique_ptr<Lane>& lane : lanes_) {
    if (unattended_)
      lane->ignore();
    else
      lane->requests().take(lane->instance());
  }
  for (Observer* observer : observers_) observer->scanned(*this);
  return problem;
}

runtime::RealTimeStats Session::runRealTime() {
  Lane& lane = *lanes_[0];
  lane.nc().setRealTime();
  const auto slice = [&lane] { lane.advance(&sim::Machine::slice); };
  return runtime::runRealTime(lane.instance(), slice, [&] {
    scans_ += lane.instance().atListStart() ? 1 : 0;
    afterScan();
    return !lane.instance().faulted() && !interrupted();
  });
}

std::string Session::advance(uint64_t count, Lane::Advance how) {
  for (uint64_t i = 0; i < count; ++i) {
    if (std::string problem = advanceOnce(how); !problem.empty()) return problem;
    if (interrupted()) return {};
  }
  return {};
}

std::string Session::runFor(int64_t us) {
  const int64_t end = nowUs() + us;
  while (nowUs() < end) {
    const int64_t before = nowUs();
    if (std::string problem = advanceOnce(&sim::Machine::scan); !problem.empty()) return problem;
    if (interrupted()) return {};
    // A stopped or faulted program may leave the clock alone; its time continues all the same.
    if (nowUs() != before) continue;
    for (const std::unique_ptr<Lane>& lane : lanes_) lane->instance().advanceClock(end - before);
  }
  return {};
}

std::string Session::restart(nc::PowerOn kind) try {
  for (const std::unique_ptr<Lane>& lane : lanes_) {
    if (kind == nc::PowerOn::Warm) lane->machine().powerOff();
    lane->powerOn(kind);
  }
  faultExpected_ = false;
  for (Observer* observer : observers_) observer->started(*this);
  return {};
} catch (const rung::Error& error) {
  return error.what();
}

// ---- statements ----------------------------------------------------------------------------------------------------

std::string Session::prefixed(const Lane& lane, const std::string& problem) const {
  return lanes_.size() > 1 ? fmt::format("[{}] {}", lane.engineName(), problem) : problem;
}

std::string Session::atScan(std::string problem) const {
  const std::string when =
      scans_ == 0 ? std::string(" (before the first scan)") : fmt::format(" ({})", scanText(scans_, nowUs()));
  problem.insert(std::min(problem.find('\n'), problem.size()), when);
  return problem;
}

std::string Session::unexpectedFault() const {
  if (faultExpected_) return {};
  for (const std::unique_ptr<Lane>& lane : lanes_)
    if (lane->instance().faulted())
      return atScan(
          fmt::format("[{}] the program stopped with a fault: {}", lane->engineName(), lane->instance().faultText()));
  return {};
}

// What the first engine holds: all hold the same.
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
  return next.ok() ? shadows_.begin(lanes_, next.value().engines) : next.error();
}

std::string Session::replace(const Statement& s) {
  const Result<NextProgram> next = makeProgram(s);
  if (!next.ok()) return next.error();
  ReplaceReport report;
  for (size_t i = 0; i < lanes_.size(); ++i)
    if (const std::string problem = lanes_[i]->replace(*next.value().engines[i], next.value().compiled, report);
        !problem.empty())
      return prefixed(*lanes_[i], problem);
  shadows_.end();
  report_ = std::move(report);
  for (Observer* observer : observers_) observer->replaced(*this, next.value());
  return difference();
}

std::string Session::expectChange(const Statement& s) {
  if (!report_) return "no program has been replaced";
  return s.kind == Kind::ExpectChange ? report_->take(s.change) : report_->expectNone();
}

std::optional<Problem> Session::execute(const Statement& s) {
  statement_ = &s;
  std::string problem = run(s);
  statement_ = nullptr;
  if (problem.empty()) return std::nullopt;
  return problemAt(s, atScan(std::move(problem)));
}

std::string Session::run(const Statement& s) {
  switch (s.kind) {
  case Kind::Include: return "a file can be included by a scenario only";
  case Kind::Program:
  case Kind::Dialect:
  case Kind::Config:
  case Kind::Connect:
  case Kind::Period:
  case Kind::ExpectError:
  case Kind::ExpectWarning:
  case Kind::AllowErrors: return "the program has started; this statement belongs to the start of a scenario";
  case Kind::Set: return forLanes([&](Lane& lane) { return setValue(lane, s); });
  case Kind::Scan: return advance(s.count, &sim::Machine::scan);
  case Kind::Fast: return advance(s.count, &sim::Machine::fast);
  case Kind::Slot:
    if (!nc().control().runsInSlots()) return "only the second level of a GSK program is run in slots (8 ms)";
    return advance(s.count, &sim::Machine::slot);
  case Kind::Run: return runFor(s.microseconds);
  case Kind::Expect:
  case Kind::ExpectRange: return forLanes([&](Lane& lane) { return expectValue(lane, s); });
  case Kind::ExpectMessage: return forLanes([&](Lane& lane) { return expectMessage(lane, s); });
  case Kind::ExpectLog: return forLanes([&](Lane& lane) { return expectLog(lane, s); });
  case Kind::ExpectCall: return forLanes([&](Lane& lane) { return lane.requests().expectCall(lane.instance(), s); });
  case Kind::ExpectNoCall:
    return forLanes([&](Lane& lane) { return lane.requests().expectNoCall(lane.instance(), s); });
  case Kind::ExpectSent: return operate([&](auto& nc, auto&) { return nc.expectSent(s.name, arguments(s.keys)); });
  case Kind::Reply: return forLanes([&](Lane& lane) { return lane.requests().reply(lane.instance(), s); });
  case Kind::Prepare: return forLanes([&](Lane& lane) { return lane.requests().prepare(lane.instance(), s); });
  case Kind::BlockStart:
    return operate([&](auto& nc, auto& program) { return nc.blockStart(program, arguments(s.keys)); });
  case Kind::BlockDone: return operate([&](auto& nc, auto& program) { return nc.blockDone(program); });
  case Kind::Event:
    return operate([&](auto& nc, auto& program) { return nc.event(program, s.name, arguments(s.keys)); });
  case Kind::Plc: return operate([&](auto& nc, auto& program) { return nc.plcCommand(program, s.name); });
  case Kind::ColdStart: return restart(nc::PowerOn::Cold);
  case Kind::WarmStart: return restart(nc::PowerOn::Warm);
  case Kind::Print: return print(s);
  case Kind::Replace: return replace(s);
  case Kind::Shadow: return shadow(s);
  case Kind::ExpectDifference: return shadows_.expectDifference(lanes_, s.name);
  case Kind::ExpectNoDifference: return shadows_.expectNone(lanes_);
  case Kind::Force: return forces_.set(lanes_, s.name, s.value);
  case Kind::Unforce: return forces_.clear(lanes_, s.words);
  case Kind::ExpectChange:
  case Kind::ExpectNoChange: return expectChange(s);
  case Kind::ExpectFault: {
    std::string problem = forLanes([&](Lane& lane) { return expectFault(lane, s); });
    faultExpected_ = faultExpected_ || problem.empty();
    return problem;
  }
  }
  return {};
}

} // namespace rung::scenario
