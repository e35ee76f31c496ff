// Forced cells of a session (see forces.h).
#include "tools/scenario/forces.h"

#include <fmt/format.h>
#include <utility>

#include "tools/scenario/names.h"

namespace rung::scenario {
namespace {

// The cell of the name, and, where the machine writes another one, that one too.
std::string addCells(const Lane& lane, const std::string& name, const Value& value,
                     std::vector<host::ForcedCell>& cells) {
  const host::Instance& instance = lane.instance();
  const rung_program& program = instance.program();
  const auto read = lane.nc().readPlace(program, name);
  if (!read && lane.nc().readCell(name)) return name + " lies in the NC: only the program's memory can be forced";
  if (!read) return unknownName(program, lane.nc(), name);
  const Result<host::ForcedCell> cell = forcedCell(instance, *read, value);
  if (!cell.ok()) return cell.error();
  cells.push_back(cell.value());
  const auto written = lane.nc().writePlace(program, name);
  if (!written || *written == *read) return {};
  const Result<host::ForcedCell> other = forcedCell(instance, *written, value);
  if (!other.ok()) return other.error();
  cells.push_back(other.value());
  return {};
}

// A shared object is machine code, whatever made it.
compiler::EngineKind kindOf(const Lane& lane) {
  return compiler::engineFromName(lane.engineName()).value_or(compiler::EngineKind::Jit);
}

} // namespace

Result<Forces::InLane> Forces::prepare(Lane& lane, const GetCompiled& compiled, const Values& values) {
  std::vector<host::ForcedCell> cells;
  for (const auto& [name, value] : values)
    if (std::string problem = addCells(lane, name, value, cells); !problem.empty()) return failure(std::move(problem));
  InLane out;
  const rung_program& program = lane.instance().program();
  out.forcing = std::make_unique<host::Forcing>(program, lane.engineContext(), cells);
  if (!out.forcing->problem().empty()) return failure(out.forcing->problem());
  if (!out.forcing->needsCode()) return out;
  const Result<const compiler::Compiled*> source = compiled();
  if (!source.ok()) return failure("the program writes a cell that is to be forced, and " + source.error());
  Result<std::unique_ptr<compiler::ForcedCode>> code =
      compiler::makeForcedCode(*source.value(), kindOf(lane), {}, program, lane.engineContext(), out.forcing->bytes());
  if (!code.ok()) return code.failure();
  out.code = std::move(code).value();
  out.forcing->setCode(out.code->code());
  return out;
}

std::string Forces::put(const Lanes& lanes, const GetCompiled& compiled, Values values) {
  std::vector<InLane> prepared;
  for (const std::unique_ptr<Lane>& lane : lanes) {
    Result<InLane> inLane = prepare(*lane, compiled, values);
    if (!inLane.ok()) return inLane.error();
    prepared.push_back(std::move(inLane).value());
  }
  for (size_t i = 0; i < lanes.size(); ++i) lanes[i]->instance().force(*prepared[i].forcing);
  inLanes_ = std::move(prepared);
  values_ = std::move(values);
  return {};
}

std::string Forces::set(const Lanes& lanes, const GetCompiled& compiled, const std::string& name, const Value& value) {
  const host::Instance& instance = lanes[0]->instance();
  if (instance.faulted()) return "a program that a fault has stopped has no forces";
  if (instance.stopped()) return "a stopped program has no forces";
  Values values = this->values(lanes);
  values[name] = value;
  return put(lanes, compiled, std::move(values));
}

std::string Forces::clear(const Lanes& lanes, const GetCompiled& compiled, const std::vector<std::string>& names) {
  Values values = this->values(lanes);
  for (const std::string& name : names)
    if (values.erase(name) == 0) return name + " is not forced";
  if (!names.empty() && !values.empty()) return put(lanes, compiled, std::move(values));
  for (const std::unique_ptr<Lane>& lane : lanes) lane->instance().endForces();
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
