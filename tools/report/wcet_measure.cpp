// The measurements (see wcet_measure.h).
#include "tools/report/wcet_measure.h"

#include <fmt/format.h>
#include <memory>

#include "compiler/engines.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/record/profile_clock.h"
#include "rtlib/run/instance.h"
#include "tools/report/scan_times.h"
#include "tools/report/wcet_step_counter.h"
#include "tools/scenario/session.h"

namespace rung::report {
namespace {

constexpr uint32_t kTimedRuns = 5; // of which the shortest time of each piece counts

class CountSteps final : public scenario::Observer {
public:
  explicit CountSteps(StepCounter& counter) : counter_(counter) {}
  void started(scenario::Session& session) override { session.instance().setTaskWatch(&counter_); }
  void scanned(const scenario::Session&) override {}

private:
  StepCounter& counter_;
};

class TimeTasks final : public scenario::Observer {
public:
  void rewind() { times_.rewind(); }
  void started(scenario::Session& session) override {
    times_.started(session.instance());
    session.instance().setTaskWatch(&times_);
  }
  void scanned(const scenario::Session&) override { times_.scanned(false); }
  double longestNs(uint32_t task) const {
    return spreadOf(times_.tasks()[task].values(), runtime::calibratedClock().nsPerTick).max;
  }

private:
  ScanTimes times_;
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

Result<void> run(const compiler::Compiled& compiled, runtime::Engine& engine, const Drive& drive,
                 scenario::Observer& observer) {
  scenario::Session session("");
  session.addEngine(engine);
  session.setCompiled([&compiled]() -> Result<const compiler::Compiled*> { return &compiled; });
  if (std::string wrong = configure(compiled, drive, session); !wrong.empty()) return failure(wrong);
  for (const sim::NcProblem& problem : session.start()) return failure(problem.text);
  session.addObserver(observer);
  for (const scenario::Statement& statement : drive.statements)
    if (const auto problem = session.execute(statement)) return failure(textOf(*problem));
  if (const std::string fault = session.unexpectedFault(); !fault.empty()) return failure(fault);
  return {};
}

} // namespace

Result<void> measure(const compiler::Compiled& compiled, runtime::Engine& machineCode, const Drive& drive,
                     Bounds& bounds) {
  StepCounter counter(bounds.tasks.size());
  CountSteps steps(counter);
  compiler::EngineOptions options;
  options.observer = [&](const compiler::Compiled& of) { return counter.observer(of.layout->partition()); };
  const Result<std::unique_ptr<runtime::Engine>> interpreter =
      compiler::makeEngine(compiler::EngineKind::Interp, compiled, options);
  if (!interpreter.ok()) return interpreter.failure();
  if (Result<void> done = run(compiled, *interpreter.value(), drive, steps); !done.ok()) return done;
  TimeTasks times;
  for (uint32_t i = 0; i < kTimedRuns; ++i) {
    times.rewind();
    if (Result<void> done = run(compiled, machineCode, drive, times); !done.ok()) return done;
  }
  for (uint32_t t = 0; t < bounds.tasks.size(); ++t) {
    const StepCounter::Count& count = counter.counts()[t];
    bounds.tasks[t].seen = {.runs = count.runs, .steps = count.most, .ns = times.longestNs(t)};
  }
  bounds.measured = drive.name;
  return {};
}

} // namespace rung::report
