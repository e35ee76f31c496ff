// Computes the bounds.
#include "tools/report/wcet_bounds.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "compiler/engines.h"
#include "ir/analysis/rung_costs.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/saturate.h"
#include "rtlib/core/queues.h"
#include "rtlib/run/realtime.h"
#include "tools/report/profile_text.h"

namespace rung::report {

namespace {

struct KnownFunction {
  HostFunction function;
  std::vector<uint64_t> most; // number of calls
};

// Properties of a program; costs are indexed by rung number.
struct Known {
  const ir::Partition& partition;
  std::vector<codegen::CodeLength> chunks;
  std::vector<uint64_t> weights;
  std::vector<uint64_t> instructions;
  std::vector<KnownFunction> functions;
  double nsPerStep = 0;
};

// The instructions of a chunk are assigned to its first rung, the only entry.
std::vector<uint64_t> instructionsOf(const ir::Partition& partition, const std::vector<codegen::CodeLength>& chunks) {
  std::vector<uint64_t> costs(partition.rungCount(), 0);
  for (uint32_t c = 0; c < chunks.size(); ++c) {
    const ir::Chunk& chunk = partition.chunks()[c];
    costs[partition.rungNumber(chunk.routine, chunk.firstRung)] = chunks[c].instructions;
  }
  return costs;
}

Known knownOf(const ir::Partition& partition, std::vector<codegen::CodeLength> chunks, double nsPerStep) {
  Known known{.partition = partition,
              .chunks = std::move(chunks),
              .weights = ir::rungWeights(partition),
              .instructions = {},
              .functions = {},
              .nsPerStep = nsPerStep};
  known.instructions = instructionsOf(partition, known.chunks);
  for (const HostFunction& function : measureHostFunctions())
    known.functions.push_back({function, ir::mostOperations(partition, function.operation)});
  return known;
}

void boundInstructions(const Known& known, const TaskCost& cost, TaskBound& task) {
  for (uint32_t c = 0; c < known.chunks.size() && task.noInstructions.empty(); ++c)
    if (cost.reaches(known.partition.chunks()[c])) task.noInstructions = known.chunks[c].unknown;
  if (task.noInstructions.empty()) task.instructions = cost.most(known.instructions);
}

TaskBound boundTask(const Known& known, ir::TaskId id) {
  const ir::Task& task = known.partition.module().tasks[id.index];
  TaskBound bound{.name = task.name,
                  .periodUs = task.periodUs,
                  .parts = task.parts,
                  .budget = task.budget,
                  .path = ir::longestPath(known.partition, id, known.weights),
                  .instructions = {},
                  .noInstructions = {},
                  .calls = {},
                  .seen = {}};
  bound.steps = bound.path.loops.empty() ? std::min<uint64_t>(bound.path.cost, task.budget) : task.budget;
  bound.codeNs = static_cast<double>(bound.steps) * known.nsPerStep;
  const TaskCost cost(known.partition, id, bound.path.loops);
  boundInstructions(known, cost, bound);
  for (const KnownFunction& of : known.functions)
    if (const uint64_t most = cost.most(of.most); most > 0) bound.calls.push_back({of.function, most});
  return bound;
}

} // namespace

double TaskBound::callsNs() const {
  double ns = 0;
  for (const HostCalls& of : calls) ns += of.ns();
  return ns;
}

Result<std::unique_ptr<codegen::JitEngine>> compileWithLengths(const compiler::Compiled& compiled) {
  codegen::JitOptions options = compiler::jitOptionsOf({});
  options.lengths = true;
  return codegen::compileJit(*compiled.layout, compiled.codeHash, options);
}

Bounds boundsOf(const compiler::Compiled& compiled, codegen::JitEngine& machineCode) {
  Bounds bounds{.program = compiled.module->name, .routines = {}, .tasks = {}, .slice = {}, .measured = {}};
  bounds.slice = runtime::measureBound({.program = machineCode.program(), .engine = machineCode.context()});
  const Known known = knownOf(compiled.layout->partition(), machineCode.report().lengths, bounds.slice.nsPerWeight);
  for (const ir::Routine& routine : compiled.module->routines) bounds.routines.push_back(routine.name);
  for (uint32_t t = 0; t < compiled.module->tasks.size(); ++t) bounds.tasks.push_back(boundTask(known, ir::TaskId{t}));
  return bounds;
}

std::vector<Stretch> stretches(const std::vector<uint32_t>& numbers) {
  std::vector<Stretch> out;
  for (const uint32_t number : numbers) {
    const bool goesOn = !out.empty() && (out.back().last == number || out.back().last + 1 == number);
    if (goesOn)
      out.back().last = number;
    else
      out.push_back({number, number});
  }
  return out;
}

std::vector<Stretch> drawnStretches(const std::vector<uint32_t>& rungs, const rung_program& program) {
  std::vector<uint32_t> numbers;
  for (const uint32_t rung : rungs)
    if (program.rungs[rung].number != 0) numbers.push_back(program.rungs[rung].number);
  return stretches(numbers);
}

// Measurement of the host functions.

namespace {

constexpr int kSweeps = 8;        // the first ones warm up caches and the links between libraries
constexpr uint32_t kBatches = 40; // more calls than queues have room for
constexpr uint32_t kCalls = 16;   // per batch, so that reading the clock costs little in comparison

void call(ir::OpCode operation, rung_ctx& ctx, uint32_t number) {
  const int64_t args[RUNG_MAX_SERVICE_ARGS] = {};
  const rung_message message{.number = number};
  switch (operation) {
  case ir::OpCode::Message: return ctx.host->message(&ctx, &message);
  case ir::OpCode::ServiceRequest: ctx.host->service_request(&ctx, 0, args, RUNG_MAX_SERVICE_ARGS); return;
  case ir::OpCode::ServicePoll: ctx.host->service_poll(&ctx, number); return;
  default: ctx.host->service_result(&ctx, number, 0);
  }
}

double nsOf(ir::OpCode operation, rung_ctx& ctx, core::HostPort& port) {
  std::array<int64_t, kBatches> fastest{};
  fastest.fill(std::numeric_limits<int64_t>::max());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    port.messages.drop();
    port.services.restart();
    for (uint32_t batch = 0; batch < kBatches; ++batch) {
      const int64_t begin = runtime::monotonicNs();
      for (uint32_t i = 0; i < kCalls; ++i) call(operation, ctx, batch * kCalls + i);
      fastest[batch] = std::min(fastest[batch], runtime::monotonicNs() - begin);
    }
  }
  return static_cast<double>(std::ranges::max(fastest)) / kCalls;
}

} // namespace

std::vector<HostFunction> measureHostFunctions() {
  const auto port = std::make_unique<core::HostPort>();
  rung_ctx ctx{.host = &core::hostApi(), .host_data = port.get()};
  std::vector<HostFunction> functions;
  for (const ir::OpCode operation :
       {ir::OpCode::Message, ir::OpCode::ServiceRequest, ir::OpCode::ServicePoll, ir::OpCode::ServiceResult})
    functions.push_back({operation, nsOf(operation, ctx, *port)});
  return functions;
}

// Costs along paths, and of what budgets allow.

TaskCost::TaskCost(const ir::Partition& partition, ir::TaskId task, const std::vector<std::vector<uint32_t>>& loops)
    : partition_(partition), task_(task), hasLoops_(!loops.empty()), inLoop_(partition.rungCount(), false),
      uses_(partition.module().routines.size(), Use::None) {
  for (const std::vector<uint32_t>& loop : loops)
    for (const uint32_t rung : loop) inLoop_[rung] = true;
  const ir::RoutineId entry = partition.module().tasks[task.index].entry;
  uses_[entry.index] = Use::Once;
  std::vector<ir::RoutineId> open{entry};
  while (!open.empty()) {
    const ir::RoutineId routine = open.back();
    open.pop_back();
    forCalls(routine, [&](uint32_t rung, ir::RoutineId callee) {
      const bool again = uses_[routine.index] == Use::Again || inLoop_[rung];
      const Use use = again ? Use::Again : Use::Once;
      if (use <= uses_[callee.index]) return;
      uses_[callee.index] = use;
      open.push_back(callee);
    });
  }
}

// A path without loops is known; for what loops may repeat, the bound is the budget that ends them, and for the rest
// everything once, because the order of the chunks is not known.
uint64_t TaskCost::most(std::span<const uint64_t> costs) const {
  if (!hasLoops_) return std::min(ir::longestPath(partition_, task_, costs).cost, allowed(costs, false));
  return std::min(saturatedSum(outsideOfLoops(costs), allowed(costs, true)), allowed(costs, false));
}

// For a run along any path: a chunk takes its weight from the budget, and its cost per weight is at most that of the
// most expensive chunk.
uint64_t TaskCost::allowed(std::span<const uint64_t> costs, bool repeatedOnly) const {
  double dearest = 0;
  for (const ir::Chunk& chunk : partition_.chunks())
    if (reaches(chunk) && (isRepeated(chunk) || !repeatedOnly))
      dearest = std::max(dearest, static_cast<double>(costOf(chunk, costs)) / chunk.weight);
  const double most = std::ceil(dearest * partition_.module().tasks[task_.index].budget);
  return most >= static_cast<double>(UINT64_MAX) ? UINT64_MAX : static_cast<uint64_t>(most);
}

uint64_t TaskCost::outsideOfLoops(std::span<const uint64_t> costs) const {
  std::vector<std::optional<uint64_t>> runs(uses_.size());
  uint64_t all = 0;
  for (const ir::Chunk& chunk : partition_.chunks())
    if (reaches(chunk) && !isRepeated(chunk))
      all = saturatedSum(all, saturatedProduct(runsOf(chunk.routine, runs), costOf(chunk, costs)));
  return all;
}

// The most runs of a routine that no loop calls; `known`: of routines found before. Calls are nested no deeper than the
// stack of rung_ctx.
uint64_t TaskCost::runsOf(ir::RoutineId routine, std::vector<std::optional<uint64_t>>& known) const {
  if (const std::optional<uint64_t>& runs = known[routine.index]) return *runs;
  uint64_t runs = routine == partition_.module().tasks[task_.index].entry ? 1 : 0;
  for (uint32_t caller = 0; caller < uses_.size(); ++caller)
    if (uses_[caller] == Use::Once)
      forCalls(ir::RoutineId{caller}, [&](uint32_t, ir::RoutineId callee) {
        if (callee == routine) runs = saturatedSum(runs, runsOf(ir::RoutineId{caller}, known));
      });
  known[routine.index] = runs;
  return runs;
}

bool TaskCost::isRepeated(const ir::Chunk& chunk) const {
  if (uses_[chunk.routine.index] == Use::Again) return true;
  for (uint32_t i = 0; i < chunk.rungCount; ++i)
    if (inLoop_[partition_.rungNumber(chunk.routine, chunk.firstRung + i)]) return true;
  return false;
}

uint64_t TaskCost::costOf(const ir::Chunk& chunk, std::span<const uint64_t> costs) const {
  uint64_t cost = 0;
  for (uint32_t i = 0; i < chunk.rungCount; ++i)
    cost = saturatedSum(cost, costs[partition_.rungNumber(chunk.routine, chunk.firstRung + i)]);
  return cost;
}

template <class Visit>
void TaskCost::forCalls(ir::RoutineId routine, Visit visit) const {
  const std::vector<ir::Rung>& rungs = partition_.module().at(routine).rungs;
  for (uint32_t i = 0; i < rungs.size(); ++i)
    if (rungs[i].transfer.kind == ir::TransferKind::Call)
      visit(partition_.rungNumber(routine, i), rungs[i].transfer.callee);
}

// Bounds as text for a terminal.

namespace {

constexpr size_t kWidth = 110;

std::string stretchText(const Stretch& s) {
  return s.first == s.last ? std::to_string(s.first) : fmt::format("{}-{}", s.first, s.last);
}

// Text wrapped to the width; lines after the first begin with the indent.
std::string wrapped(std::string text, const std::string& indent) {
  for (size_t line = 0; text.size() - line > kWidth;) {
    size_t end = text.rfind(' ', line + kWidth);
    if (end == std::string::npos || end <= text.find_first_not_of(' ', line)) end = text.find(' ', line + kWidth);
    if (end == std::string::npos) break;
    text.replace(end, 1, "\n" + indent);
    line = end + 1;
  }
  return text + "\n";
}

std::string counted(uint64_t steps) { return fmt::format("{} step{}", steps, steps == 1 ? "" : "s"); }

std::string rungsText(const std::vector<uint32_t>& rungs, const rung_program& program) {
  const std::vector<Stretch> drawn = drawnStretches(rungs, program);
  if (drawn.empty()) return "only rungs added by the compiler";
  std::string text = drawn.size() == 1 && drawn[0].first == drawn[0].last ? "rung" : "rungs";
  for (size_t i = 0; i < drawn.size(); ++i) text += (i == 0 ? " " : ", ") + stretchText(drawn[i]);
  return text;
}

// The calls on the path, in the order of the first call of each routine.
std::string calleesText(const ir::RoutinePath& path, const Bounds& bounds, const rung_program& program) {
  std::vector<ir::RoutineId> order;
  std::map<uint32_t, std::vector<uint32_t>> callers; // rung numbers
  for (const ir::RoutinePath::Call& call : path.calls) {
    std::vector<uint32_t>& rungs = callers[call.callee.index];
    if (rungs.empty()) order.push_back(call.callee);
    rungs.push_back(call.rung);
  }
  std::string text;
  for (const ir::RoutineId callee : order)
    text += fmt::format("{} {} from {}", text.empty() ? "; calls" : ",", bounds.routines[callee.index],
                        rungsText(callers[callee.index], program));
  return text;
}

std::string pathText(const TaskBound& task, const Bounds& bounds, const rung_program& program) {
  std::string text;
  for (const ir::RoutinePath& path : task.path.routines) {
    std::string line = "  " + bounds.routines[path.routine.index];
    if (&path == &task.path.routines[0] && task.parts > 1) line += fmt::format(", part {}", task.path.part + 1);
    if (&path != &task.path.routines[0]) line += ", " + counted(path.cost);
    if (path.runs != 1) line += fmt::format(", {} times", path.runs);
    text += wrapped(line + ": " + rungsText(path.rungs, program) + calleesText(path, bounds, program), "    ");
  }
  return text;
}

std::string loopText(const std::vector<uint32_t>& rungs, const rung_program& program) {
  return fmt::format("{}, {}", rungsText(rungs, program), program.routines[program.rungs[rungs.front()].routine]);
}

std::string loopsText(const TaskBound& task, const rung_program& program) {
  std::string text;
  for (const std::vector<uint32_t>& rungs : task.path.loops)
    text += wrapped(fmt::format("  loop: {}", loopText(rungs, program)), "    ");
  if (text.empty()) return text;
  return text + fmt::format("  the budget of {} steps ends the run; with each loop run once, the longest path has {}\n",
                            task.budget, task.path.cost);
}

std::string stepsText(const TaskBound& task) {
  if (!task.path.loops.empty()) return counted(task.budget) + ", the whole budget: the program may loop";
  if (task.path.cost > task.budget)
    return fmt::format("{}, the whole budget: the longest path has {}", counted(task.budget), task.path.cost);
  return fmt::format("{} of a budget of {}", counted(task.path.cost), task.budget);
}

std::string seenText(const TaskBound& task) {
  if (!task.seen) return {};
  if (task.seen->runs == 0) return "  measured: the task did not run\n";
  return fmt::format("  measured in {} {}{}: {}, {} including process-image copies\n", task.seen->runs,
                     task.parts > 1 ? "part" : "run", task.seen->runs == 1 ? "" : "s", counted(task.seen->steps),
                     durationText(task.seen->ns));
}

// "at most 3 calls of message, 2 of service_poll"
std::string callsText(const TaskBound& task) {
  std::string text;
  for (const HostCalls& calls : task.calls) {
    const std::string_view unit = !text.empty() ? "" : calls.count == 1 ? "call " : "calls ";
    text += fmt::format("{}{} {}of {}", text.empty() ? "at most " : ", ", calls.count, unit,
                        ir::opInfo(calls.function.operation).name);
  }
  return text;
}

std::string instructionsText(const TaskBound& task) {
  std::string text = task.instructions ? std::to_string(*task.instructions) : "no bound, " + task.noInstructions;
  if (!task.calls.empty()) text += (task.instructions ? ", and " : "; ") + callsText(task);
  return fmt::format("  machine instructions: {}\n", text);
}

std::string timeText(const TaskBound& task) {
  std::string text = durationText(task.ns());
  if (!task.calls.empty()) text += fmt::format(", {} of it in these calls", durationText(task.callsNs()));
  return fmt::format("  time on this computer: {}\n", text);
}

std::string taskText(const TaskBound& task, const Bounds& bounds, const rung_program& program) {
  std::string text = task.parts > 1 ? fmt::format("{}, a part of {}", task.name, task.parts) : task.name;
  text += fmt::format(": at most {}\n", stepsText(task));
  text += instructionsText(task) + timeText(task);
  return text + seenText(task) + loopsText(task, program) + pathText(task, bounds, program);
}

// The bound of a slice has each loop once; the time that budgets allow is printed beside it.
std::string sliceText(const Bounds& bounds, const rung_program& program) {
  std::string loops;
  double most = 0;
  for (const TaskBound& task : bounds.tasks) {
    for (const std::vector<uint32_t>& rungs : task.path.loops)
      loops += (loops.empty() ? "" : "; ") + loopText(rungs, program);
    if (!task.path.loops.empty()) most = std::max(most, task.ns());
  }
  const std::string bound = boundText(bounds.slice, program);
  if (loops.empty()) return wrapped("longest slice, including process-image copies: " + bound, "  ");
  return wrapped(fmt::format("longest slice, including process-image copies, each loop ({}) counted once: {}; a run "
                             "that loops may last {}",
                             loops, bound, durationText(most)),
                 "  ");
}

} // namespace

std::string textOf(const Bounds& bounds, const rung_program& program) {
  std::string text;
  for (const TaskBound& task : bounds.tasks) text += taskText(task, bounds, program) + "\n";
  text += sliceText(bounds, program);
  if (!bounds.measured.empty()) text += fmt::format("measured: {}\n", bounds.measured);
  return text;
}

// Bounds as JSON (docs/wcet-format.md).

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

Json pathJson(const ir::RoutinePath& path, const Bounds& bounds, const rung_program& program) {
  Json json = {{"routine", bounds.routines[path.routine.index]}, {"runs", path.runs}, {"steps", path.cost}};
  json.update(rungsJson(path.rungs, program));
  json["calls"] = Json::array();
  for (const ir::RoutinePath::Call& call : path.calls)
    json["calls"].push_back({{"rung", program.rungs[call.rung].number},
                             {"index", call.rung},
                             {"routine", bounds.routines[call.callee.index]}});
  return json;
}

Json taskJson(const TaskBound& task, const Bounds& bounds, const rung_program& program) {
  Json json = {{"name", task.name},
               {"period_us", task.periodUs},
               {"parts", task.parts},
               {"part", task.path.part + 1},
               {"budget", task.budget},
               {"steps", task.steps},
               {"path_steps", task.path.cost},
               {"time_ns", task.ns()}};
  json["instructions"] = task.instructions ? Json(*task.instructions) : Json(nullptr);
  if (!task.instructions) json["no_instructions"] = task.noInstructions;
  json["calls"] = Json::array();
  for (const HostCalls& calls : task.calls)
    json["calls"].push_back({{"function", ir::opInfo(calls.function.operation).name},
                             {"count", calls.count},
                             {"call_ns", calls.function.ns}});
  json["loops"] = Json::array();
  for (const std::vector<uint32_t>& loop : task.path.loops) json["loops"].push_back(rungsJson(loop, program));
  json["path"] = Json::array();
  for (const ir::RoutinePath& path : task.path.routines) json["path"].push_back(pathJson(path, bounds, program));
  if (task.seen)
    json["measured"] = {{"runs", task.seen->runs}, {"steps", task.seen->steps}, {"time_ns", task.seen->ns}};
  return json;
}

// Null if unknown: a bound that counts each loop once can show that a slice is too long, but not that it fits.
Json fitsJson(const runtime::ScanBound& slice) {
  if (slice.loops && slice.fits()) return nullptr;
  return slice.fits();
}

} // namespace

std::string jsonOf(const Bounds& bounds, const rung_program& program) {
  Json json = {{"wcet", 1}, {"program", bounds.program}, {"dialect", program.dialect}};
  json["slice"] = {{"steps", bounds.slice.weight},       {"time_ns", bounds.slice.ns},
                   {"period_ns", bounds.slice.periodNs}, {"step_ns", bounds.slice.nsPerWeight},
                   {"loops", bounds.slice.loops},        {"fits", fitsJson(bounds.slice)}};
  if (!bounds.measured.empty()) json["measured_by"] = bounds.measured;
  json["tasks"] = Json::array();
  for (const TaskBound& task : bounds.tasks) json["tasks"].push_back(taskJson(task, bounds, program));
  // Names come from source files of any encoding: invalid UTF-8 is replaced, and does not throw.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace rung::report
