// The trace of a scenario (see scenario_trace.h).
#include "tools/rungc/scenario_trace.h"

#include <fmt/format.h>
#include <utility>

#include "tools/rungc/commands.h"

namespace rung::rungc {

void ScenarioTrace::addTo(Command command) {
  Option trace =
      command.option("--trace", path_,
                     "Write the values of names after every scan to FILE.vcd (changes) or FILE.csv (one row per scan)");
  command.option("--watch", names_, "Names to trace; default: every name and address that the rungs use")
      .needs(trace)
      .manyValues();
}

std::string ScenarioTrace::problem(size_t scenarios) const {
  if (!wanted()) return {};
  if (scenarios != 1) return fmt::format("--trace takes one scenario, not {}", scenarios);
  const std::string file = scenario::traceFileProblem(path_);
  return file.empty() ? file : "--trace: " + file;
}

void ScenarioTrace::attach(scenario::RunOptions& run) {
  if (!wanted()) return;
  refused_ = false;
  run.started = [this](scenario::Session& session, const compiler::Compiled& program) {
    return begin(session, program);
  };
}

std::string ScenarioTrace::begin(scenario::Session& session, const compiler::Compiled& program) {
  const rung_program& tables = session.instance().program();
  const std::vector<std::string> names =
      names_.empty() ? scenario::defaultTraceNames(tables, program.uses.get()) : names_;
  std::string unknown = scenario::Trace::nameProblem(names, session.instance(), session.nc());
  refused_ = !unknown.empty();
  if (refused_) return "--watch: " + unknown;
  Result<std::unique_ptr<scenario::Trace>> trace =
      scenario::Trace::open(path_, names, session.instance(), session.nc());
  if (!trace.ok()) return trace.error();
  trace_ = std::move(trace).value();
  session.addObserver(*trace_);
  return {};
}

std::string ScenarioTrace::finish() {
  if (trace_ == nullptr) return {};
  const std::string error = trace_->finish();
  trace_.reset();
  return error;
}

} // namespace rung::rungc
