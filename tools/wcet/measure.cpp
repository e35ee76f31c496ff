// The measurements (see measure.h).
#include "tools/wcet/measure.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "rtlib/core/ticks.h"
#include "rtlib/host/instance.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/profile/clock.h"
#include "tools/compiler/engines.h"
#include "tools/profile/scan_times.h"
#include "tools/scenario/session.h"

namespace rung::wcet {
namespace {

constexpr uint32_t kTimedRuns = 5; // of which the shortest time of each piece counts

// Watches the tasks of a session's program, also after a restart.
class TaskObserver : public scenario::Observer, public host::TaskWatch {
public:
  void started(scenario::Session& session) override { session.instance().setTaskWatch(this); }
  void scanned(const scenario::Session&) override {}
};

class CountSteps final : public TaskObserver {
public:
  explicit CountSteps(size_t tasks) : seen_(tasks) {}

  // Counts while the engine that has it runs.
  class Weigher final : public ir::RungObserver {
  public:
    Weigher(const ir::Layout& layout, uint64_t& steps) : weights_(ir::rungWeights(layout)), steps_(steps) {}
    void rungRan(uint32_t number, std::span<const uint64_t>) override { steps_ += weights_[number]; }

  private:
    std::vector<uint64_t> weights_;
    uint64_t& steps_;
  };
  std::unique_ptr<ir::RungObserver> weigher(const ir::Layout& layout) {
    return std::make_unique<Weigher>(layout, steps_);
  }

  void begins(const host::Instance&, uint32_t) override { steps_ = 0; }
  void ended(const host::Instance&, uint32_t task) override {
    ++seen_[task].runs;
    seen_[task].steps = std::max(seen_[task].steps, steps_);
  }
  const std::vector<Seen>& seen() const { return seen_; }

private:
  uint64_t steps_ = 0; // of the run
  std::vector<Seen> seen_;
};

class TimeTasks final : public TaskObserver {
public:
  explicit TimeTasks(size_t tasks) : times_(tasks) {}
  void rewind() {
    for (profile::Shortest& times : times_) times.rewind();
  }
  void begins(const host::Instance&, uint32_t) override { start_ = rt::readTicks(); }
  void ended(const host::Instance&, uint32_t task) override {
    const double used = static_cast<double>(rt::readTicks() - start_) - profile::calibratedClock().costTicks;
    times_[task].add(used <= 0 ? 0 : static_cast<uint64_t>(used));
  }
  double longestNs(uint32_t task) const {
    return profile::spreadOf(times_[task].values(), profile::calibratedClock().nsPerTick).max;
  }

private:
  uint64_t start_ = 0;
  std::vector<profile::Shortest> times_; // by task
};

std::string configure(const compiler::Compiled& compiled, const Drive& drive, scenario::Session& session) {
  for (const auto& [key, value] : drive.config) {
    const nc::ConfigKey* row = nc::findConfigKey(compiled.dialect->configKeys, key);
    if (row != nullptr && row->reader == nc::ConfigReader::Compiler) continue;
    if (std::string wrong = session.config(key, value); !wrong.empty()) return wrong;
  }
  for (const scenario::Statement& connect : drive.connects)
    if (std::string wrong = session.connect(connect.words[0], connect.words[1]); !wrong.empty())
      return textOf(problemAt(connect, std::move(wrong)));
  return {};
}

Result<void> run(const compiler::Compiled& compiled, host::Engine& engine, const Drive& drive,
                 scenario::Observer& observer) {
  scenario::Session session("");
  session.addEngine(engine);
  if (std::string wrong = configure(compiled, drive, session); !wrong.empty()) return failure(wrong);
  for (const sim::NcProblem& problem : session.start()) return failure(problem.text);
  session.setUnattended();
  session.addObserver(observer);
  for (const scenario::Statement& statement : drive.statements)
    if (const auto problem = session.execute(statement)) return failure(textOf(*problem));
  if (const std::string fault = session.unexpectedFault(); !fault.empty()) return failure(fault);
  return {};
}

} // namespace

Result<void> measure(const compiler::Compiled& compiled, host::Engine& machineCode, const Drive& drive,
                     Bounds& bounds) {
  CountSteps steps(bounds.tasks.size());
  compiler::EngineOptions options;
  options.observer = [&](const compiler::Compiled& of) { return steps.weigher(*of.layout); };
  const Result<std::unique_ptr<host::Engine>> interpreter =
      compiler::makeEngine(compiler::EngineKind::Interp, compiled, options);
  if (!interpreter.ok()) return interpreter.failure();
  if (Result<void> done = run(compiled, *interpreter.value(), drive, steps); !done.ok()) return done;
  TimeTasks times(bounds.tasks.size());
  for (uint32_t i = 0; i < kTimedRuns; ++i) {
    times.rewind();
    if (Result<void> done = run(compiled, machineCode, drive, times); !done.ok()) return done;
  }
  for (uint32_t t = 0; t < bounds.tasks.size(); ++t) {
    bounds.tasks[t].seen = steps.seen()[t];
    bounds.tasks[t].seen->ns = times.longestNs(t);
  }
  bounds.measured = drive.name;
  return {};
}

} // namespace rung::wcet
