// A running program that takes statements (see session.h).
#include "tools/scenario/session.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "rtlib/host/compare.h"
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

void Session::addEngine(host::Engine& engine) { lanes_.push_back(std::make_unique<Lane>(engine, folder_)); }

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
    if (const auto found = host::firstDifference(instance(), lanes_[i]->instance(), nc::describe))
      return fmt::format("engines disagree: {} against {}: {}", lanes_[0]->engineName(), lanes_[i]->engineName(),
                         *found);
  return {};
}

std::string Session::advanceOnce(Lane::Advance how) {
  for (const std::unique_ptr<Lane>& lane : lanes_) lane->advance(how);
  ++scans_;
  return afterScan();
}

std::string Session::afterScan() {
  std::string problem = difference();
  for (const std::unique_ptr<Lane>& lane : lanes_) {
    if (unattended_)
      lane->ignore();
    else
      lane->requests().take(lane->instance());
  }
  for (Observer* observer : observers_) observer->scanned(*this);
  return problem;
}

host::RealTimeStats Session::runRealTime() {
  Lane& lane = *lanes_[0];
  lane.nc().betweenSlices(lane.instance());
  return host::runRealTime(lane.instance(), [&] {
    lane.takeMessages();
    scans_ += lane.instance().atListStart() ? 1 : 0;
    lane.nc().betweenSlices(lane.instance());
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
    if (std::string problem = advanceOnce(&sim::SimulatedNc::scan); !problem.empty()) return problem;
    if (interrupted()) return {};
    // A stopped or faulted program may leave the clock alone; its time goes on all the same.
    if (nowUs() != before) continue;
    for (const std::unique_ptr<Lane>& lane : lanes_) lane->instance().advanceClock(end - before);
  }
  return {};
}

void Session::restart(nc::PowerOn kind) {
  for (const std::unique_ptr<Lane>& lane : lanes_) {
    if (kind == nc::PowerOn::Warm) lane->nc().powerOff(lane->instance());
    lane->powerOn(kind);
  }
  faultExpected_ = false;
  for (Observer* observer : observers_) observer->started(*this);
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

std::string Session::replace(const Statement& s) {
  if (!makeProgram_) return "no program can be compiled here to take over";
  const Result<NextProgram> next = makeProgram_(s);
  if (!next.ok()) return next.error();
  const rung_program& program = next.value().engines[0]->program();
  if (std::string_view(program.dialect) != instance().program().dialect)
    return fmt::format("{} is a program of {}, and the one that runs is of {}", program.name, program.dialect,
                       instance().program().dialect);
  ReplaceReport report;
  for (size_t i = 0; i < lanes_.size(); ++i)
    if (const std::string problem = lanes_[i]->replace(*next.value().engines[i], report); !problem.empty())
      return prefixed(*lanes_[i], problem);
  report_ = std::move(report);
  compiled_ = next.value().compiled;
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
  case Kind::Scan: return advance(s.count, &sim::SimulatedNc::scan);
  case Kind::Fast: return advance(s.count, &sim::SimulatedNc::fast);
  case Kind::Slot:
    if (!nc().control().runsInSlots()) return "only the second level of a GSK program is run in slots (8 ms)";
    return advance(s.count, &sim::SimulatedNc::slot);
  case Kind::Run: return runFor(s.microseconds);
  case Kind::Expect:
  case Kind::ExpectRange: return forLanes([&](Lane& lane) { return expectValue(lane, s); });
  case Kind::ExpectMessage: return forLanes([&](Lane& lane) { return expectMessage(lane, s); });
  case Kind::ExpectLog: return forLanes([&](Lane& lane) { return expectLog(lane, s); });
  case Kind::ExpectCall: return forLanes([&](Lane& lane) { return lane.requests().expectCall(lane.instance(), s); });
  case Kind::ExpectNoCall:
    return forLanes([&](Lane& lane) { return lane.requests().expectNoCall(lane.instance(), s); });
  case Kind::Reply: return forLanes([&](Lane& lane) { return lane.requests().reply(lane.instance(), s); });
  case Kind::Prepare: return forLanes([&](Lane& lane) { return lane.requests().prepare(lane.instance(), s); });
  case Kind::BlockStart:
    return forLanes([&](Lane& lane) { return lane.nc().blockStart(lane.instance(), arguments(s.keys)); });
  case Kind::BlockDone: return forLanes([&](Lane& lane) { return lane.nc().blockDone(lane.instance()); });
  case Kind::Event:
    return forLanes([&](Lane& lane) { return lane.nc().event(lane.instance(), s.name, arguments(s.keys)); });
  case Kind::Plc: return forLanes([&](Lane& lane) { return lane.nc().plcCommand(lane.instance(), s.name); });
  case Kind::ColdStart: restart(nc::PowerOn::Cold); return {};
  case Kind::WarmStart: restart(nc::PowerOn::Warm); return {};
  case Kind::Print: return print(s);
  case Kind::Replace: return replace(s);
  case Kind::Force: return forces_.set(lanes_, compiled_, s.name, s.value);
  case Kind::Unforce: return forces_.clear(lanes_, compiled_, s.words);
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
