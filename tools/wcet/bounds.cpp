// The bounds (see bounds.h).
#include "tools/wcet/bounds.h"

#include <algorithm>

#include "codegen/jit/instruction_bound.h"
#include "tools/compiler/engines.h"

namespace rung::wcet {
namespace {

// What a run may take until its budget is used up, whatever way it goes: a chunk takes its weight from the budget, and
// no more instructions for that than the dearest one.
uint64_t whatBudgetAllows(const ir::Layout& layout, const std::vector<ir::RoutineId>& routines,
                          const std::vector<codegen::CodeLength>& chunks, uint32_t budget) {
  double dearest = 0;
  for (uint32_t c = 0; c < chunks.size(); ++c) {
    const ir::Chunk& chunk = layout.chunks()[c];
    if (std::ranges::find(routines, chunk.routine) == routines.end()) continue;
    dearest = std::max(dearest, static_cast<double>(chunks[c].instructions) / chunk.weight);
  }
  const double most = dearest * budget + 1;
  return most >= static_cast<double>(UINT64_MAX) ? UINT64_MAX : static_cast<uint64_t>(most);
}

// Each chunk's instructions are those of its first rung: it is entered nowhere else.
void boundInstructions(const ir::Layout& layout, ir::TaskId id, const std::vector<codegen::CodeLength>& chunks,
                       TaskBound& task) {
  const std::vector<ir::RoutineId> routines = ir::reachedRoutines(layout, id);
  std::vector<uint64_t> costs(layout.rungCount(), 0);
  for (uint32_t c = 0; c < chunks.size(); ++c) {
    const ir::Chunk& chunk = layout.chunks()[c];
    costs[layout.rungNumber(chunk.routine, chunk.firstRung)] = chunks[c].instructions;
    if (std::ranges::find(routines, chunk.routine) == routines.end()) continue;
    task.callsHost = task.callsHost || chunks[c].callsHost;
    if (task.noInstructions.empty()) task.noInstructions = chunks[c].unknown;
  }
  if (!task.noInstructions.empty()) return;
  const uint64_t allowed = whatBudgetAllows(layout, routines, chunks, task.budget);
  task.instructions = task.way.circles.empty() ? std::min(ir::heaviestWay(layout, id, costs).cost, allowed) : allowed;
}

} // namespace

Result<Bounds> boundsOf(const compiler::Compiled& compiled, host::Engine& machineCode) {
  const ir::Layout& layout = *compiled.layout;
  Bounds bounds{.program = compiled.module->name, .tasks = {}, .slice = {}, .measured = {}};
  const Result<std::vector<codegen::CodeLength>> chunks =
      codegen::boundInstructions(layout, compiled.codeHash, compiler::jitOptionsOf({}).code);
  if (!chunks.ok()) return chunks.failure();
  bounds.slice = host::measureBound({.program = machineCode.program(), .engine = machineCode.context()});
  const std::vector<uint64_t> weights = ir::rungWeights(layout);
  for (uint32_t t = 0; t < compiled.module->tasks.size(); ++t) {
    const ir::Task& task = compiled.module->tasks[t];
    TaskBound bound{.name = task.name,
                    .periodUs = task.periodUs,
                    .parts = task.parts,
                    .budget = task.budget,
                    .way = ir::heaviestWay(layout, ir::TaskId{t}, weights),
                    .instructions = {},
                    .noInstructions = {},
                    .seen = {}};
    bound.steps = bound.way.circles.empty() ? std::min<uint64_t>(bound.way.cost, task.budget) : task.budget;
    bound.ns = static_cast<double>(bound.steps) * bounds.slice.nsPerWeight;
    boundInstructions(layout, ir::TaskId{t}, chunks.value(), bound);
    bounds.tasks.push_back(std::move(bound));
  }
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

} // namespace rung::wcet
