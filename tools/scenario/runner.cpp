// The scenario runner (see runner.h).
#include "tools/scenario/runner.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

#include "rtlib/host/compare.h"
#include "rtlib/host/program_info.h"
#include "rtlib/nc/model/nc_model.h"
#include "tools/scenario/compile_step.h"
#include "tools/scenario/services.h"
#include "tools/scenario/values.h"

namespace rung::scenario {
namespace {

using host::Instance;
using host::Ref;

// One engine's run of the scenario.
struct Lane {
  host::Engine* engine = nullptr;
  std::unique_ptr<nc::NcModel> nc;
  std::unique_ptr<Instance> instance;
  std::vector<std::string> unreadLog; // since the last expect_log
  struct Claimed {
    rt::ServiceRequest request;
    Prepared answer;
  };
  std::vector<Claimed> claimed;            // requests with an operand block, answered when the scan is over
  std::vector<rt::ServiceRequest> waiting; // requests that nobody has looked at, oldest first
  std::vector<rt::ServiceRequest> taken;   // requests that expect_call consumed, oldest first
  std::vector<Prepared> prepared;          // answers that wait for their request
  bool calledOneWay = false;               // the last request that expect_call consumed takes no answer

  // The answer prepared for the request, taken out; nothing when there is none. A running task has its memory for
  // itself: then only answers that ask for no word of the block are looked at.
  std::optional<Prepared> takePrepared(const ServiceSignature& signature, const rt::ServiceRequest& request,
                                       bool running = false) {
    for (size_t i = 0; i < prepared.size(); ++i) {
      if (running && namesWords(signature, prepared[i].keys)) continue;
      if (!requestDifference(signature, request, prepared[i].service, prepared[i].keys, instance.get()).empty())
        continue;
      const Prepared found = std::move(prepared[i]);
      prepared.erase(prepared.begin() + static_cast<std::ptrdiff_t>(i));
      return found;
    }
    return std::nullopt;
  }
  void answer(const ServiceSignature& signature, const rt::ServiceRequest& request,
              const std::vector<KeyValue>& results) {
    answerBlock(*instance, signature, request, results);
    instance->services().complete(replyOf(signature, request.ticket, results));
  }
};

// Lends the NC model's hooks and adds the scenario's prepared answers.
class LaneHooks final : public host::ScheduleHooks {
public:
  explicit LaneHooks(Lane& lane) : lane_(lane) {}
  void onHook(Instance& instance, uint32_t work) override { lane_.nc->onHook(instance, work); }
  void onFault(Instance& instance) override { lane_.nc->onFault(instance); }
  bool respond(Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) override {
    if (lane_.prepared.empty()) return lane_.nc->respond(instance, request, reply);
    const ServiceSignature signature(host::serviceName(instance.program(), request.service));
    const auto prepared = lane_.takePrepared(signature, request, true);
    if (!prepared) return lane_.nc->respond(instance, request, reply);
    if (signature.hasBlock()) {
      lane_.claimed.push_back({request, *prepared});
      reply.state = RUNG_SERVICE_PENDING;
    } else {
      reply = replyOf(signature, request.ticket, prepared->results);
    }
    return true;
  }

private:
  Lane& lane_;
};

class Runner {
public:
  Runner(const Scenario& scenario, const RunOptions& options) : scenario_(scenario), options_(options) {}

  RunResult run() {
    CompileStep step = compileProgram(scenario_, options_.programs, options_.strict, options_.instrument);
    result_.environment = step.environment;
    result_.problems = step.problems;
    if (step.program && result_.environment.empty() && result_.problems.empty() &&
        startLanes(store().enter(std::move(*step.program))))
      runStatements();
    if (!lanes_.empty() && options_.instrument)
      result_.profile =
          profile::makeReport(lanes_[0].instance->program(), lanes_[0].instance->profile(), profile::nsPerTick());
    result_.passed = result_.problems.empty() && result_.environment.empty();
    return std::move(result_);
  }

private:
  void fail(const Statement& statement, std::string message) {
    result_.problems.push_back({statement.line, std::move(message)});
  }

  EngineStore& store() { return options_.store != nullptr ? *options_.store : ownStore_; }

  bool startLanes(StoredProgram& program) {
    lanes_.reserve(options_.engines.size());
    hooks_.reserve(options_.engines.size());
    for (driver::EngineKind kind : options_.engines) {
      Lane& lane = lanes_.emplace_back();
      Result<host::Engine*> engine = program.engine(kind, options_.engine);
      if (!engine.ok()) {
        result_.environment = engine.error();
        return false;
      }
      lane.engine = engine.value();
      lane.nc = nc::makeNcModel(lane.engine->program().dialect);
      lane.nc->setFolder(std::filesystem::path(scenario_.path).parent_path().string());
      hooks_.push_back(std::make_unique<LaneHooks>(lane));
      lane.instance = driver::makeInstance(*lane.engine, hooks_.back().get());
      if (!configure(lane, *program.compiled().dialect)) return false;
      lane.nc->powerOn(*lane.instance, nc::PowerOn::Cold);
      if (!connected(lane)) return false;
    }
    return compare(scenario_.statements[0]);
  }

  // The ends of connections are known when the program has started.
  bool connected(const Lane& lane) {
    const std::vector<nc::NcProblem> problems = lane.nc->connectionProblems();
    std::vector<const Statement*> connects;
    for (const Statement& s : scenario_.statements)
      if (s.kind == Kind::Connect) connects.push_back(&s);
    for (const nc::NcProblem& problem : problems)
      fail(problem.connection < connects.size() ? *connects[problem.connection] : scenario_.statements[0],
           problem.text);
    return problems.empty();
  }

  bool configure(Lane& lane, const frontend::Dialect& dialect) {
    for (const Statement& s : scenario_.statements) {
      std::string problem;
      if (s.kind == Kind::Config && !readsKey(dialect, s.name)) problem = lane.nc->config(s.name, s.value.text);
      if (s.kind == Kind::Connect) problem = lane.nc->connect(s.words[0], s.words[1]);
      if (problem.empty()) continue;
      fail(s, problem);
      return false;
    }
    return true;
  }

  void runStatements() {
    for (const Statement& s : scenario_.statements) {
      execute(s);
      if (!result_.problems.empty()) return; // what follows would only repeat it
    }
    for (const Lane& lane : lanes_)
      if (lane.instance->faulted() && !faultExpected_)
        return fail(scenario_.statements.back(), fmt::format("[{}] the program stopped with a fault: {}",
                                                             lane.engine->name(), lane.instance->faultText()));
  }

  // The engines must agree after every scan.
  bool compare(const Statement& s) {
    for (size_t i = 1; i < lanes_.size(); ++i)
      if (const auto difference = host::firstDifference(*lanes_[0].instance, *lanes_[i].instance)) {
        fail(s, fmt::format("engines disagree after scan {}: {} against {}: {}", result_.scans,
                            lanes_[0].engine->name(), lanes_[i].engine->name(), *difference));
        return false;
      }
    return true;
  }

  using Advance = void (nc::NcModel::*)(Instance&);
  bool advanceOnce(const Statement& s, Advance advance) {
    for (Lane& lane : lanes_) {
      (lane.nc.get()->*advance)(*lane.instance);
      for (std::string& line : lane.nc->board().takeLog()) lane.unreadLog.push_back(std::move(line));
    }
    ++result_.scans;
    if (!compare(s)) return false;
    for (Lane& lane : lanes_) takeRequests(lane);
    return true;
  }

  // The requests that the NC model left in the queue. Prepared answers to operand blocks are given here, and what takes
  // no answer is complete.
  static void takeRequests(Lane& lane) {
    rt::ServiceRequest request;
    for (const Lane::Claimed& claimed : lane.claimed)
      lane.answer(ServiceSignature(host::serviceName(lane.instance->program(), claimed.request.service)),
                  claimed.request, claimed.answer.results);
    lane.claimed.clear();
    while (lane.instance->services().take(request)) {
      const ServiceSignature signature(host::serviceName(lane.instance->program(), request.service));
      if (signature.takesNoAnswer()) lane.answer(signature, request, {});
      const auto prepared = signature.hasBlock() ? lane.takePrepared(signature, request) : std::nullopt;
      if (prepared)
        lane.answer(signature, request, prepared->results);
      else
        lane.waiting.push_back(request);
    }
  }

  void advance(const Statement& s, Advance how) {
    for (uint64_t i = 0; i < s.count; ++i)
      if (!advanceOnce(s, how)) return;
  }

  void runFor(const Statement& s) {
    const int64_t end = lanes_[0].instance->nowUs() + s.microseconds;
    while (lanes_[0].instance->nowUs() < end) {
      const int64_t before = lanes_[0].instance->nowUs();
      if (!advanceOnce(s, &nc::NcModel::scan)) return;
      // A stopped or faulted program may leave the clock alone; its time goes on all the same.
      if (lanes_[0].instance->nowUs() != before) continue;
      for (Lane& lane : lanes_) lane.instance->advanceClock(end - before);
    }
  }

  void restart(nc::PowerOn kind) {
    for (Lane& lane : lanes_) {
      if (kind == nc::PowerOn::Warm) lane.nc->powerOff(*lane.instance);
      lane.nc->powerOn(*lane.instance, kind);
      lane.unreadLog.clear();
      lane.claimed.clear();
      lane.waiting.clear();
      lane.taken.clear();
      lane.prepared.clear();
    }
    faultExpected_ = false;
  }

  // Calls act(lane) for every lane; a text it gives is a problem of this statement.
  template <class Act>
  void forLanes(const Statement& s, Act act) {
    for (Lane& lane : lanes_) {
      const std::string problem = act(lane);
      if (!problem.empty())
        return fail(s, lanes_.size() > 1 ? fmt::format("[{}] {}", lane.engine->name(), problem) : problem);
    }
  }

  void execute(const Statement& s);
  std::string setValue(Lane& lane, const Statement& s);
  std::string expectValue(Lane& lane, const Statement& s);
  std::string expectMessage(Lane& lane, const Statement& s);
  std::string expectLog(Lane& lane, const Statement& s);
  std::string expectCall(Lane& lane, const Statement& s);
  std::string expectNoCall(Lane& lane, const Statement& s);
  std::string replyTo(Lane& lane, const Statement& s);
  std::string prepare(Lane& lane, const Statement& s);
  std::string expectFault(Lane& lane, const Statement& s);

  const Scenario& scenario_;
  const RunOptions& options_;
  RunResult result_;
  EngineStore ownStore_; // when the options bring none; outlives the instances
  std::vector<Lane> lanes_;
  std::vector<std::unique_ptr<LaneHooks>> hooks_;
  bool faultExpected_ = false;
};

void Runner::execute(const Statement& s) {
  switch (s.kind) {
  case Kind::Program:
  case Kind::Dialect:
  case Kind::Config:
  case Kind::Connect:
  case Kind::Period:
  case Kind::ExpectError:
  case Kind::ExpectWarning: return; // done before the first scan
  case Kind::Set: return forLanes(s, [&](Lane& lane) { return setValue(lane, s); });
  case Kind::Scan: return advance(s, &nc::NcModel::scan);
  case Kind::Fast: return advance(s, &nc::NcModel::fast);
  case Kind::Slot:
    if (std::string_view(lanes_[0].engine->program().dialect) != "gsk")
      return fail(s, "only the second level of a GSK program is run in slots (8 ms)");
    return advance(s, &nc::NcModel::slot);
  case Kind::Run: return runFor(s);
  case Kind::Expect:
  case Kind::ExpectRange: return forLanes(s, [&](Lane& lane) { return expectValue(lane, s); });
  case Kind::ExpectMessage: return forLanes(s, [&](Lane& lane) { return expectMessage(lane, s); });
  case Kind::ExpectLog: return forLanes(s, [&](Lane& lane) { return expectLog(lane, s); });
  case Kind::ExpectCall: return forLanes(s, [&](Lane& lane) { return expectCall(lane, s); });
  case Kind::ExpectNoCall: return forLanes(s, [&](Lane& lane) { return expectNoCall(lane, s); });
  case Kind::Reply: return forLanes(s, [&](Lane& lane) { return replyTo(lane, s); });
  case Kind::Prepare: return forLanes(s, [&](Lane& lane) { return prepare(lane, s); });
  case Kind::BlockStart:
    return forLanes(s, [&](Lane& lane) { return lane.nc->blockStart(*lane.instance, arguments(s.keys)); });
  case Kind::BlockDone: return forLanes(s, [&](Lane& lane) { return lane.nc->blockDone(*lane.instance); });
  case Kind::Event:
    return forLanes(s, [&](Lane& lane) { return lane.nc->event(*lane.instance, s.name, arguments(s.keys)); });
  case Kind::Plc: return forLanes(s, [&](Lane& lane) { return lane.nc->plcCommand(*lane.instance, s.name); });
  case Kind::ColdStart: return restart(nc::PowerOn::Cold);
  case Kind::WarmStart: return restart(nc::PowerOn::Warm);
  case Kind::ExpectFault: faultExpected_ = true; return forLanes(s, [&](Lane& lane) { return expectFault(lane, s); });
  }
}

std::string Runner::setValue(Lane& lane, const Statement& s) {
  if (s.name.starts_with("NC.")) return lane.nc->setQuantity(std::string_view(s.name).substr(3), s.value.real);
  const std::optional<Ref> place = lane.nc->writePlace(*lane.instance, s.name);
  if (!place && s.value.kind != ValueKind::Text && lane.nc->writeCell(s.name, cellOf(s.value))) return {};
  if (!place) return fmt::format("'{}' is no name of this program", s.name);
  return writeValue(*lane.instance, *place, s.value);
}

std::string Runner::expectValue(Lane& lane, const Statement& s) {
  Reading reading;
  if (s.name.starts_with("NC.")) {
    const auto quantity = lane.nc->quantity(std::string_view(s.name).substr(3));
    if (!quantity) return fmt::format("the simulated NC has no quantity '{}'", s.name);
    reading = realReading(*quantity);
  } else {
    const std::optional<Ref> place = lane.nc->readPlace(*lane.instance, s.name);
    const auto cell = place ? std::nullopt : lane.nc->readCell(s.name);
    if (!place && !cell) return fmt::format("'{}' is no name of this program", s.name);
    const bool wantReal = s.near || s.value.kind == ValueKind::Real || s.high.kind == ValueKind::Real;
    reading = place ? readValue(*lane.instance, *place, wantReal) : cellReading(*cell);
  }
  return s.kind == Kind::ExpectRange ? checkRange(reading, s) : checkValue(reading, s);
}

// Of several messages with this number one must (or none may) have the properties.
std::string Runner::expectMessage(Lane& lane, const Statement& s) {
  std::string seen;
  std::string difference;
  for (const nc::ShownMessage& message : lane.nc->messages(*lane.instance)) {
    seen += fmt::format("{}{}", seen.empty() ? "" : ", ", message.number);
    if (message.number != s.number) continue;
    std::string own = messageDifference(message, s.keys);
    if (own.empty()) return s.on ? std::string() : fmt::format("message {} is displayed", s.number);
    if (difference.empty()) difference = std::move(own);
  }
  if (!s.on) return {};
  return difference.empty()
             ? fmt::format("message {} is not displayed; there is {}", s.number, seen.empty() ? "none" : seen)
             : difference;
}

std::string Runner::expectLog(Lane& lane, const Statement& s) {
  for (size_t i = 0; i < lane.unreadLog.size(); ++i)
    if (lane.unreadLog[i].find(s.value.text) != std::string::npos) {
      lane.unreadLog.clear();
      return {};
    }
  std::string seen;
  for (const std::string& line : lane.unreadLog) seen += "\n  " + line;
  return fmt::format("no log entry contains \"{}\"{}{}", s.value.text, seen.empty() ? "" : "; there are:", seen);
}

std::string Runner::expectCall(Lane& lane, const Statement& s) {
  takeRequests(lane);
  if (lane.waiting.empty()) return fmt::format("no request waits; expected {}", s.name);
  const rt::ServiceRequest next = lane.waiting.front();
  const ServiceSignature signature(host::serviceName(lane.instance->program(), next.service));
  const std::string difference = requestDifference(signature, next, s.name, s.keys, lane.instance.get());
  if (!difference.empty()) return difference;
  lane.waiting.erase(lane.waiting.begin());
  lane.calledOneWay = signature.takesNoAnswer();
  if (!lane.calledOneWay) lane.taken.push_back(next);
  return {};
}

std::string Runner::expectNoCall(Lane& lane, const Statement& s) {
  takeRequests(lane);
  for (const rt::ServiceRequest& waiting : lane.waiting) {
    const ServiceSignature signature(host::serviceName(lane.instance->program(), waiting.service));
    if (s.name.empty() || signature.isNamed(s.name)) return fmt::format("a request {} waits", signature.name());
  }
  return {};
}

std::string Runner::replyTo(Lane& lane, const Statement& s) {
  takeRequests(lane);
  if (std::exchange(lane.calledOneWay, false) && s.results.empty()) return {}; // it is complete
  const auto signatureOf = [&](const rt::ServiceRequest& request) {
    return ServiceSignature(host::serviceName(lane.instance->program(), request.service));
  };
  std::vector<rt::ServiceRequest>& pending = lane.taken.empty() ? lane.waiting : lane.taken;
  const auto next =
      std::ranges::find_if(pending, [&](const auto& request) { return !signatureOf(request).takesNoAnswer(); });
  if (next == pending.end()) return "no request is pending";
  const rt::ServiceRequest request = *next;
  const ServiceSignature signature = signatureOf(request);
  const std::string problem = keyProblem(signature, {}, s.results);
  if (!problem.empty()) return problem;
  pending.erase(next);
  lane.answer(signature, request, s.results);
  return {};
}

std::string Runner::prepare(Lane& lane, const Statement& s) {
  const rung_program& program = lane.instance->program();
  for (uint32_t i = 0; i < program.service_count; ++i) {
    const ServiceSignature signature(host::serviceName(program, i));
    if (!signature.isNamed(s.name)) continue;
    const std::string problem = keyProblem(signature, s.keys, s.results);
    if (problem.empty()) lane.prepared.push_back({s.name, s.keys, s.results});
    return problem;
  }
  return fmt::format("this program asks for no service {}", s.name);
}

std::string Runner::expectFault(Lane& lane, const Statement& s) {
  if (!lane.instance->faulted()) return fmt::format("the program runs; expected the fault \"{}\"", s.value.text);
  const std::string text = lane.instance->faultText();
  return text.find(s.value.text) != std::string::npos
             ? std::string()
             : fmt::format("the fault is \"{}\", expected \"{}\"", text, s.value.text);
}

} // namespace

RunResult run(const Scenario& scenario, const RunOptions& options) { return Runner(scenario, options).run(); }

} // namespace rung::scenario
