// The bounds (see bounds.h).
#include "tools/report/wcet_bounds.h"

#include <algorithm>

#include "compiler/engines.h"
#include "ir/analysis/rung_costs.h"
#include "tools/report/wcet_task_cost.h"

namespace rung::report {
namespace {

struct KnownFunction {
  HostFunction function;
  std::vector<uint64_t> most; // calls
};

// Of a program; costs are those of rungs, by their numbers.
struct Known {
  const ir::Cut& cut;
  std::vector<codegen::CodeLength> chunks;
  std::vector<uint64_t> weights;
  std::vector<uint64_t> instructions;
  std::vector<KnownFunction> functions;
  double nsPerStep = 0;
};

// A chunk's instructions are those of its first rung: it is entered nowhere else.
std::vector<uint64_t> instructionsOf(const ir::Cut& cut, const std::vector<codegen::CodeLength>& chunks) {
  std::vector<uint64_t> costs(cut.rungCount(), 0);
  for (uint32_t c = 0; c < chunks.size(); ++c) {
    const ir::Chunk& chunk = cut.chunks()[c];
    costs[cut.rungNumber(chunk.routine, chunk.firstRung)] = chunks[c].instructions;
  }
  return costs;
}

Known knownOf(const ir::Cut& cut, std::vector<codegen::CodeLength> chunks, double nsPerStep) {
  Known known{.cut = cut,
              .chunks = std::move(chunks),
              .weights = ir::rungWeights(cut),
              .instructions = {},
              .functions = {},
              .nsPerStep = nsPerStep};
  known.instructions = instructionsOf(cut, known.chunks);
  for (const HostFunction& function : measureHostFunctions())
    known.functions.push_back({function, ir::mostOperations(cut, function.operation)});
  return known;
}

void boundInstructions(const Known& known, const TaskCost& cost, TaskBound& task) {
  for (uint32_t c = 0; c < known.chunks.size() && task.noInstructions.empty(); ++c)
    if (cost.reaches(known.cut.chunks()[c])) task.noInstructions = known.chunks[c].unknown;
  if (task.noInstructions.empty()) task.instructions = cost.most(known.instructions);
}

TaskBound boundTask(const Known& known, ir::TaskId id) {
  const ir::Task& task = known.cut.module().tasks[id.index];
  TaskBound bound{.name = task.name,
                  .periodUs = task.periodUs,
                  .parts = task.parts,
                  .budget = task.budget,
                  .way = ir::heaviestWay(known.cut, id, known.weights),
                  .instructions = {},
                  .noInstructions = {},
                  .calls = {},
                  .seen = {}};
  bound.steps = bound.way.circles.empty() ? std::min<uint64_t>(bound.way.cost, task.budget) : task.budget;
  bound.codeNs = static_cast<double>(bound.steps) * known.nsPerStep;
  const TaskCost cost(known.cut, id, bound.way.circles);
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
  const Known known = knownOf(compiled.layout->cut(), machineCode.report().lengths, bounds.slice.nsPerWeight);
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

} // namespace rung::report
