// Forced cells of a session (see forces.h).
#include "tools/scenario/forces.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

#include "tools/scenario/names.h"

namespace rung::scenario {
namespace {

Result<rung_forced_cell> cellOf(const EngineRun& run, const std::string& name, const Value& value) {
  const rung_program& program = run.instance().program();
  const auto read = run.nc().readPlace(program, name);
  if (!read && run.nc().readCell(name))
    return failure(name + " lies in the NC: only the program's memory can be forced");
  if (!read) return failure(unknownName(program, run.nc(), name));
  return forcedCell(run.instance(), name, *read, value);
}

Result<rung::Forces> prepare(EngineRun& run, const Forces::Values& values) try {
  std::vector<rung_forced_cell> cells;
  for (const auto& [name, value] : values) {
    const Result<rung_forced_cell> cell = cellOf(run, name, value);
    if (!cell.ok()) return cell.failure();
    cells.push_back(cell.value());
  }
  return rung::Forces(run.machine().instance(), cells);
} catch (const rung::Error& error) {
  return failure(error.what());
}

void force(EngineRun& run, rung_forces* forces) {
  (void)rung_instance_force(run.machine().instance().handle(), forces); // the first run has accepted it
}

} // namespace

std::string Forces::put(const EngineRuns& runs, Values values) {
  std::vector<rung::Forces> prepared;
  for (const std::unique_ptr<EngineRun>& run : runs) {
    Result<rung::Forces> inRun = prepare(*run, values);
    if (!inRun.ok()) return inRun.error();
    prepared.push_back(std::move(inRun).value());
  }
  for (size_t i = 0; i < runs.size(); ++i) force(*runs[i], prepared[i].handle());
  inRuns_ = std::move(prepared);
  values_ = std::move(values);
  return {};
}

Forces::Values::const_iterator Forces::find(const EngineRuns& runs, const Values& values, const std::string& name) {
  const auto placeOf = [&](const std::string& of) {
    return runs[0]->nc().readPlace(runs[0]->instance().program(), of);
  };
  const std::optional<runtime::Ref> wanted = placeOf(name);
  return std::ranges::find_if(values, [&](const auto& force) {
    const auto place = wanted ? placeOf(force.first) : std::nullopt;
    return force.first == name || (place && runtime::isSamePlace(*place, *wanted));
  });
}

std::string Forces::set(const EngineRuns& runs, const std::string& name, const Value& value) {
  const runtime::Instance& instance = runs[0]->instance();
  if (instance.faulted()) return "a program that a fault has stopped has no forces";
  if (instance.stopped()) return "a stopped program has no forces";
  Values values = this->values(runs);
  if (const auto former = find(runs, values, name); former != values.end()) values.erase(former);
  values[name] = value;
  return put(runs, std::move(values));
}

std::string Forces::clear(const EngineRuns& runs, const std::vector<std::string>& names) {
  Values values = this->values(runs);
  for (const std::string& name : names)
    if (const auto force = find(runs, values, name); force != values.end())
      values.erase(force);
    else
      return name + " is not forced";
  return restore(runs, names.empty() ? Values() : values);
}

std::string Forces::restore(const EngineRuns& runs, const Values& values) {
  if (!values.empty()) return put(runs, values);
  for (const std::unique_ptr<EngineRun>& run : runs) force(*run, nullptr);
  values_.clear();
  inRuns_.clear();
  return {};
}

// Forces end at a fault, a stop, a power-on and when another program takes over.
const Forces::Values& Forces::values(const EngineRuns& runs) {
  if (!runs[0]->instance().forced()) values_.clear();
  return values_;
}

} // namespace rung::scenario
