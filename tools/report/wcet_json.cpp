// Bounds as JSON (docs/wcet-format.md).
#include <nlohmann/json.hpp>

#include "ir/core/op_info.h"
#include "tools/report/wcet_bounds.h"

namespace rung::report {
namespace {

using Json = nlohmann::ordered_json;

Json stretchesJson(const std::vector<Stretch>& stretches) {
  Json json = Json::array();
  for (const Stretch& stretch : stretches) json.push_back({stretch.first, stretch.last});
  return json;
}

Json rungsJson(const std::vector<uint32_t>& rungs, const rung_program& program) {
  return {{"rungs", stretchesJson(drawnStretches(rungs, program))}, {"index", stretchesJson(stretches(rungs))}};
}

Json wayJson(const ir::RoutineWay& way, const Bounds& bounds, const rung_program& program) {
  Json json = {{"routine", bounds.routines[way.routine.index]}, {"runs", way.runs}, {"steps", way.cost}};
  json.update(rungsJson(way.rungs, program));
  json["calls"] = Json::array();
  for (const ir::RoutineWay::Call& call : way.calls)
    json["calls"].push_back({{"rung", program.rungs[call.rung].number},
                             {"index", call.rung},
                             {"routine", bounds.routines[call.callee.index]}});
  return json;
}

Json taskJson(const TaskBound& task, const Bounds& bounds, const rung_program& program) {
  Json json = {{"name", task.name},          {"period_us", task.periodUs}, {"parts", task.parts},
               {"part", task.way.part + 1},  {"budget", task.budget},      {"steps", task.steps},
               {"way_steps", task.way.cost}, {"time_ns", task.ns()}};
  json["instructions"] = task.instructions ? Json(*task.instructions) : Json(nullptr);
  if (!task.instructions) json["no_instructions"] = task.noInstructions;
  json["calls"] = Json::array();
  for (const HostCalls& calls : task.calls)
    json["calls"].push_back({{"function", ir::opInfo(calls.function.operation).name},
                             {"count", calls.count},
                             {"call_ns", calls.function.ns}});
  json["circles"] = Json::array();
  for (const std::vector<uint32_t>& circle : task.way.circles) json["circles"].push_back(rungsJson(circle, program));
  json["way"] = Json::array();
  for (const ir::RoutineWay& way : task.way.routines) json["way"].push_back(wayJson(way, bounds, program));
  if (task.seen)
    json["measured"] = {{"runs", task.seen->runs}, {"steps", task.seen->steps}, {"time_ns", task.seen->ns}};
  return json;
}

// Null where nobody knows: a bound that has each loop once may show that a slice is too long, not that it fits.
Json fitsJson(const runtime::ScanBound& slice) {
  if (slice.circles && slice.fits()) return nullptr;
  return slice.fits();
}

} // namespace

std::string jsonOf(const Bounds& bounds, const rung_program& program) {
  Json json = {{"wcet", 1}, {"program", bounds.program}, {"dialect", program.dialect}};
  json["slice"] = {{"steps", bounds.slice.weight},       {"time_ns", bounds.slice.ns},
                   {"period_ns", bounds.slice.periodNs}, {"step_ns", bounds.slice.nsPerWeight},
                   {"circles", bounds.slice.circles},    {"fits", fitsJson(bounds.slice)}};
  if (!bounds.measured.empty()) json["measured_by"] = bounds.measured;
  json["tasks"] = Json::array();
  for (const TaskBound& task : bounds.tasks) json["tasks"].push_back(taskJson(task, bounds, program));
  // Names come from source files of any encoding: what is not UTF-8 is replaced, not thrown.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace rung::report
