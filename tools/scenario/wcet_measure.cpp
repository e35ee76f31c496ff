// The measurements (see wcet_measure.h).
#include "tools/scenario/wcet_measure.h"

#include <fmt/format.h>
#include <memory>

#include "compiler/engines.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/record/profile_clock.h"
#include "rtlib/run/instance.h"
#include "tools/report/scan_times.h"
#include "tools/report/wcet_step_counter.h"
#include "tools/scenario/session.h"

namespace rung::scenario {
namespace {

constexpr uint32_t kTimedRuns = 5; // the shortest time of each part over these runs counts

class CountSteps final : public Observer {
public:
  explicit CountSteps(report::StepCounter& counter) : counter_(counter) {}
  void started(Session& session) override { session.instance().setTaskWatch(&counter_); }
  void scanned(const Session&) override {}

private:
  report::StepCounter& counter_;
};

class TimeTasks final : public Observer {
public:
  void rewind() { times_.rewind(); }
  void started(Session& session) override {
    times_.started(session.instance());
    session.instance().setTaskWatch(&times_);
  }
  void scanned(const Session&) override { times_.scanned(false); }
  double longestNs(uint32_t task) const {
    return report::spreadOf(times_.tasks()[task].values(), runtime::calibratedClock().nsPerTick).max;
  }

private:
  report::ScanTimes times_;
};

std::string configure(const compiler::Compiled& compiled, const TaskDrive& drive, Session& session) {
  for (const auto& [key, value] : drive.config) {
    const nc::ConfigKey* row = nc::findConfigKey(compiled.dialect->configKeys, key);
    if (row != nullptr && row->reader == nc::ConfigReader::Compiler) continue;
    if (std::string wrong = session.config(key, value); !wrong.empty()) return wrong;
  }
  for (const Statement& connect : drive.connects)
    if (std::string wrong = session.connect(connect.words[0], connect.words[1]); !wrong.empty())
      return textOf(problemAt(connect, std::move(wrong)));
  return {};
}

Result<void> run(const compiler::Compiled& compiled, runtime::Engine& engine, const TaskDrive& drive,
                 Observer& observer) {
  Session session("");
  session.addEngine(engine);
  session.setCompiled([&compiled]() -> Result<const compiler::Compiled*> { return &compiled; });
  if (std::string wrong = configure(compiled, drive, session); !wrong.empty()) return failure(wrong);
  for (const sim::NcProblem& problem : session.start()) return failure(problem.text);
  session.addObserver(observer);
  for (const Statement& statement : drive.statements)
    if (const auto problem = session.execute(statement)) return failure(textOf(*problem));
  if (const std::string fault = session.unexpectedFault(); !fault.empty()) return failure(fault);
  return {};
}

} // namespace

Result<void> measureTasks(const compiler::Compiled& compiled, runtime::Engine& machineCode, const TaskDrive& drive,
                          report::Bounds& bounds) {
  report::StepCounter counter(bounds.tasks.size());
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
    const report::StepCounter::Count& count = counter.counts()[t];
    bounds.tasks[t].seen = {.runs = count.runs, .steps = count.most, .ns = times.longestNs(t)};
  }
  bounds.measured = drive.name;
  return {};
}

} // namespace rung::scenario
