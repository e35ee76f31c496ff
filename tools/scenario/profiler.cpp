// The measurements of a profile (see profiler.h).
#include "tools/scenario/profiler.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "tools/report/profile_branches.h"
#include "tools/report/scan_times.h"
#include "tools/scenario/statements.h"

namespace rung::scenario {
namespace {

constexpr size_t kMaxCauses = 5;
constexpr double kCauseShare = 0.02; // share of the scan: a smaller one does not explain anything

// A whole scan: its number in its scenario, and where it ran.
struct Place {
  std::string scenario;
  uint64_t scan = 0;
  int64_t timeUs = 0;
  std::string file;
  uint32_t line = 0;
};

// Common to all measurements: counts the scans.
class Measurement : public Observer {
public:
  virtual void rewind() { scans_ = 0; }
  void enter(const Scenario& scenario) { scenario_ = scenario.path; }
  uint64_t scans() const { return scans_; }
  const rung_program* program() const { return program_; }
  // Whether the scenarios are not all of one program.
  bool differs() const { return differs_; }
  bool replaced() const { return replaced_; }

  void started(Session& session) override {
    const rung_program& program = session.instance().program();
    differs_ = differs_ || (program_ != nullptr && program_->code_hash != program.code_hash);
    program_ = &program;
    if (!differs_) begin(session.instance());
  }
  void replaced(const Session&, const NextProgram&) override { replaced_ = true; }
  void scanned(const Session& session) override {
    if (differs_ || replaced_) return;
    const Statement& s = *session.statement();
    const Advance advances = StatementInfo::of(s).advances;
    const bool whole = advances == Advance::Scans || advances == Advance::Time;
    end(session.instance(), whole, Place{scenario_, session.scans(), session.nowUs(), s.file, s.line});
    scans_ += whole ? 1 : 0;
  }

protected:
  // Called when the instance has been switched on.
  virtual void begin(runtime::Instance& instance) = 0;
  virtual void end(const runtime::Instance& instance, bool whole, const Place& place) = 0;

private:
  std::string scenario_;
  const rung_program* program_ = nullptr;
  uint64_t scans_ = 0;
  bool differs_ = false;
  bool replaced_ = false;
};

// Reads counters of rungs in any unit; remembers the cost of each rung in one scan.
class RungMeasurement : public Measurement {
public:
  explicit RungMeasurement(double cost) : collector_(0, cost) {}
  const report::ProfileCollector& collector() const { return collector_; }
  const Place& place() const { return place_; }
  const std::vector<uint64_t>& remembered() const { return remembered_; }

protected:
  void begin(runtime::Instance& instance) override {
    if (collector_.rungs().empty())
      collector_ = report::ProfileCollector(instance.program().rung_count, collector_.cost());
    collector_.started(instance.profile());
  }

  report::ProfileCollector collector_; // without rungs before the first start
  Place place_;
  std::vector<uint64_t> remembered_;
};

// Only counts the scans.
class RunOnly final : public Measurement {
protected:
  void begin(runtime::Instance&) override {}
  void end(const runtime::Instance&, bool, const Place&) override {}
};

// Counts operations; remembers the scan with the most.
class CountOperations final : public RungMeasurement {
public:
  CountOperations() : RungMeasurement(0) {}
  const std::vector<uint64_t>& totals() const { return totals_; }

protected:
  void end(const runtime::Instance& instance, bool whole, const Place& place) override {
    collector_.scanned(instance.profile());
    if (!whole) return;
    totals_.push_back(collector_.lastScanTotal());
    if (totals_.size() > 1 && totals_.back() <= most_) return;
    most_ = totals_.back();
    place_ = place;
    remembered_.assign(collector_.lastScan().begin(), collector_.lastScan().end());
  }

private:
  std::vector<uint64_t> totals_; // of whole scans
  uint64_t most_ = 0;
};

// Measures whole scans on the engine that the machine will use.
class TimeScans final : public Measurement {
public:
  void rewind() override {
    Measurement::rewind();
    times_.rewind();
  }
  const report::ScanTimes& times() const { return times_; }
  size_t longest() const {
    const std::vector<uint64_t>& values = times_.scans().values();
    return static_cast<size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  }

protected:
  void begin(runtime::Instance& instance) override {
    instance.setTaskWatch(&times_);
    times_.started(instance);
  }
  void end(const runtime::Instance&, bool whole, const Place&) override { times_.scanned(whole); }

private:
  report::ScanTimes times_;
};

// Measures rungs; remembers their shortest times in scan `which`.
class TimeRungs final : public RungMeasurement {
public:
  explicit TimeRungs(size_t which) : RungMeasurement(runtime::calibratedClock().costTicks), which_(which) {}
  void rewind() override {
    RungMeasurement::rewind();
    times_.rewind();
  }
  const report::ScanTimes& times() const { return times_; }

protected:
  void begin(runtime::Instance& instance) override {
    RungMeasurement::begin(instance);
    instance.setTaskWatch(&times_);
    times_.started(instance);
  }
  void end(const runtime::Instance& instance, bool whole, const Place& place) override {
    collector_.scanned(instance.profile());
    times_.scanned(whole);
    if (!whole || scans() != which_) return;
    place_ = place;
    const std::span<const uint64_t> last = collector_.lastScan();
    remembered_.resize(last.size(), UINT64_MAX);
    for (size_t i = 0; i < last.size(); ++i) remembered_[i] = std::min(remembered_[i], last[i]);
  }

private:
  size_t which_;
  report::ScanTimes times_;
};

// Median over all scans: 0 if the rung runs in fewer than half of them.
double usualOf(const report::ProfileCollector& collector, uint32_t which) {
  const report::ProfileCollector::Rung& rung = collector.rungs()[which];
  const double idle = static_cast<double>(collector.scans() - rung.scans) / static_cast<double>(collector.scans());
  return idle >= 0.5 ? 0 : std::max(0.0, rung.perScan.quantile((0.5 - idle) / (1 - idle)) - collector.cost());
}

report::WorstScan explain(const report::ProfileReport& report, const RungMeasurement& measured, double scale,
                          double value, double usual) {
  const Place& place = measured.place();
  report::WorstScan worst{true, place.scenario, place.scan, place.timeUs, place.file, place.line, value, usual, {}};
  const report::ProfileCollector& collector = measured.collector();
  for (const std::vector<report::Row>* rows : {&report.rows, &report.added})
    for (const report::Row& row : *rows) {
      report::Cause cause{row, static_cast<double>(measured.remembered()[row.rung]) * scale,
                          usualOf(collector, row.rung) * scale, row.scans == 1};
      if (cause.value - cause.usual >= kCauseShare * value) worst.causes.push_back(std::move(cause));
    }
  std::stable_sort(worst.causes.begin(), worst.causes.end(), [](const report::Cause& a, const report::Cause& b) {
    return a.value - a.usual > b.value - b.usual;
  });
  if (worst.causes.size() > kMaxCauses) worst.causes.resize(kMaxCauses);
  return worst;
}

class Profiler {
public:
  explicit Profiler(const ProfileRequest& request) : request_(request) {}

  ProfileOutcome run() {
    CountOperations operations;
    compiler::EngineOptions counting;
    counting.countOperations = true;
    if (!measure("counting operations", operations, 1, compiler::EngineKind::Interp, counting, true))
      return std::move(outcome_);
    TimeScans scans;
    if (!measure("timing scans", scans, request_.repeat, request_.engine, {}, false)) return std::move(outcome_);
    TimeRungs rungs(scans.longest());
    if (!measure("timing rungs", rungs, request_.repeat, request_.engine, {}, true)) return std::move(outcome_);
    if (!agree(operations, rungs)) return std::move(outcome_);
    if (request_.branches != nullptr && !countBranches(*request_.branches)) return std::move(outcome_);
    outcome_.profile = assemble(operations, scans, rungs);
    outcome_.done = true;
    return std::move(outcome_);
  }

private:
  bool fail(const std::string& scenario, std::string message) {
    outcome_.scenario = scenario;
    outcome_.result.passed = false;
    outcome_.result.environment = std::move(message);
    return false;
  }

  // Runs all scenarios `repeat` times.
  bool measure(const char* what, Measurement& measurement, uint32_t repeat, compiler::EngineKind engine,
               const compiler::EngineOptions& options, bool instrument) {
    RunOptions run;
    run.engines = {engine};
    run.engine = options;
    run.instrument = instrument;
    run.programs = request_.programs;
    run.store = stores_.emplace_back(std::make_unique<EngineStore>()).get();
    run.started = [&measurement](Session& session, const compiler::Compiled&) {
      session.addObserver(measurement);
      return std::string();
    };
    for (uint32_t i = 0; i < repeat; ++i) {
      measurement.rewind();
      for (const Scenario& scenario : request_.scenarios) {
        measurement.enter(scenario);
        if (request_.progress)
          request_.progress(fmt::format("{}, run {} of {}: {}", what, i + 1, repeat, scenario.path));
        outcome_.result = scenario::run(scenario, run);
        outcome_.scenario = scenario.path;
        if (!outcome_.result.passed) return false;
        if (measurement.program() == nullptr) return fail(scenario.path, "it runs no program");
        if (measurement.replaced())
          return fail(scenario.path, "the scenario replaces its program; a profile needs a single program");
        if (measurement.differs())
          return fail(
              scenario.path,
              fmt::format("it runs a different program than {} (other files or configuration): profile them separately",
                          request_.scenarios[0].path));
      }
    }
    return true;
  }

  bool countBranches(ir::BranchCounts& counts) {
    RunOnly runs;
    compiler::EngineOptions watched;
    watched.observer = [&](const compiler::Compiled& compiled) {
      return std::make_unique<report::BranchCounter>(*compiled.module, counts);
    };
    return measure("counting branches", runs, 1, compiler::EngineKind::Interp, watched, false);
  }

  // A scenario must do the same in every run, or its counts would mean nothing.
  bool agree(const CountOperations& operations, const TimeRungs& rungs) {
    for (uint32_t i = 0; i < operations.program()->rung_count; ++i) {
      const uint64_t once = operations.collector().rungs()[i].executions;
      const uint64_t all = rungs.collector().rungs()[i].executions;
      if (once * request_.repeat != all)
        return fail(request_.scenarios[0].path,
                    fmt::format("its runs differ: rung {} ran {} times in one run on interp and {} times in {} runs on "
                                "{}",
                                i, once, all, request_.repeat, compiler::engineName(request_.engine)));
    }
    return true;
  }

  report::Profile assemble(const CountOperations& operations, const TimeScans& scans, const TimeRungs& rungs) const {
    const rung_program& program = *rungs.program();
    const double scale = runtime::calibratedClock().nsPerTick;
    report::Profile profile;
    profile.report = report::makeReport(program, &operations.collector(), &rungs.collector(),
                                        runtime::calibratedClock(), request_.order);
    profile.engine = compiler::engineName(request_.engine);
    for (const Scenario& scenario : request_.scenarios) profile.scenarios.push_back(scenario.path);
    profile.codeHash = scans.program()->code_hash;
    profile.scans = operations.scans();
    profile.repeat = request_.repeat;
    profile.scanOperations = report::spreadOf(operations.totals(), 1);
    profile.deadlines = scans.times().deadlines(program, runtime::calibratedClock());
    profile.measuredScanNs = report::spreadOf(rungs.times().scans().values(), scale).median;
    if (operations.scans() == 0) return profile;
    const report::Spread& counts = profile.scanOperations;
    profile.worstByOperations = explain(profile.report, operations, 1, counts.max, counts.median);
    const report::Spread& times = profile.deadlines[0].ns;
    profile.worstByTime = explain(profile.report, rungs, scale, times.max, times.median);
    return profile;
  }

  const ProfileRequest& request_;
  ProfileOutcome outcome_;
  std::vector<std::unique_ptr<EngineStore>> stores_; // of the measurements; the report refers to their programs
};

} // namespace

ProfileOutcome profileScenarios(const ProfileRequest& request) { return Profiler(request).run(); }

} // namespace rung::scenario
