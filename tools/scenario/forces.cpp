// Forced cells of a session (see forces.h).
#include "tools/scenario/forces.h"

#include <fmt/format.h>
#include <utility>

#include "tools/scenario/names.h"

namespace rung::scenario {
namespace {

Result<rung_forced_cell> cellOf(const Lane& lane, const std::string& name, const Value& value) {
  const rung_program& program = lane.instance().program();
  const auto read = lane.nc().readPlace(program, name);
  if (!read && lane.nc().readCell(name))
    return failure(name + " lies in the NC: only the program's memory can be forced");
  if (!read) return failure(unknownName(program, lane.nc(), name));
  return forcedCell(lane.instance(), name, *read, value);
}

Result<rung::Forces> prepare(Lane& lane, const Forces::Values& values) try {
  std::vector<rung_forced_cell> cells;
  for (const auto& [name, value] : values) {
    const Result<rung_forced_cell> cell = cellOf(lane, name, value);
    if (!cell.ok()) return cell.failure();
    cells.push_back(cell.value());
  }
  return rung::Forces(lane.machine().instance(), cells);
} catch (const rung::Error& error) {
  return failure(error.what());
}

void force(Lane& lane, rung_forces* forces) {
  (void)rung_instance_force(lane.machine().instance().handle(), forces); // the first lane was asked before
}

} // namespace

std::string Forces::put(const Lanes& lanes, Values values) {
  std::vector<rung::Forces> prepared;
  for (const std::unique_ptr<Lane>& lane : lanes) {
    Result<rung::Forces> inLane = prepare(*lane, values);
    if (!inLane.ok()) return inLane.error();
    prepared.push_back(std::move(inLane).value());
  }
  for (size_t i = 0; i < lanes.size(); ++i) force(*lanes[i], prepared[i].handle());
  inLanes_ = std::move(prepared);
  values_ = std::move(values);
  return {};
}

std::string Forces::set(const Lanes& lanes, const std::string& name, const Value& value) {
  const runtime::Instance& instance = lanes[0]->instance();
  if (instance.faulted()) return "a program that a fault has stopped has no forces";
  if (instance.stopped()) return "a stopped program has no forces";
  Values values = this->values(lanes);
  values[name] = value;
  return put(lanes, std::move(values));
}

std::string Forces::clear(const Lanes& lanes, const std::vector<std::string>& names) {
  Values values = this->values(lanes);
  for (const std::string& name : names)
    if (values.erase(name) == 0) return name + " is not forced";
  if (!names.empty() && !values.empty()) return put(lanes, std::move(values));
  for (const std::unique_ptr<Lane>& lane : lanes) force(*lane, nullptr);
  values_.clear();
  inLanes_.clear();
  return {};
}

// They end by themselves at a fault, a stop, a power-on and when another program takes over.
const Forces::Values& Forces::values(const Lanes& lanes) {
  if (!lanes[0]->instance().forced()) values_.clear();
  return values_;
}

} // namespace rung::scenario
