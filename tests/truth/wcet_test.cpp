// `rungc wcet` against the most steps that runs take in the interpreter, with random inputs: no run of a task takes
// more than its bound, and the bound is not only large.
#include <span>

#include <gtest/gtest.h>

#include "tests/truth/programs.h"
#include "tools/report/wcet_bounds.h"
#include "tools/report/wcet_step_counter.h"

namespace rung::truth {
namespace {

std::vector<report::StepCounter::Count> countSteps(const compiler::Compiled& compiled, int scans) {
  report::StepCounter counter(compiled.module->tasks.size());
  compiler::EngineOptions options;
  options.observer = [&](const compiler::Compiled& of) { return counter.observer(of.layout->partition()); };
  const auto engine = compiler::makeEngine(compiler::EngineKind::Interp, compiled, options);
  if (!engine.ok()) {
    ADD_FAILURE() << engine.error();
    return counter.counts();
  }
  runtime::Instance instance(*engine.value());
  instance.setTaskWatch(&counter);
  ir::RandomSource random(5);
  for (int i = 0; i < scans; ++i) {
    if (instance.faulted()) instance.coldStart();
    scatter(instance, random);
    instance.scan();
  }
  return counter.counts();
}

TEST(Wcet, IsNeverLessThanRunsTake) {
  uint32_t bounded = 0;
  uint32_t close = 0; // a run took four fifths of its bound
  for (const Text& text : drawnTexts()) {
    SCOPED_TRACE(text.file);
    const std::unique_ptr<Program> program = Program::of(text);
    if (!program) continue;
    const compiler::Compiled& compiled = program->compiled();
    const auto counts = countSteps(compiled, isLarge() ? 200 : 20);
    const ir::Partition& cut = compiled.layout->partition();
    for (uint32_t t = 0; t < compiled.module->tasks.size(); ++t) {
      const ir::LongestPath way = ir::longestPath(cut, ir::TaskId{t}, ir::rungWeights(cut));
      if (!way.loops.empty() || counts[t].runs == 0) continue;
      EXPECT_LE(counts[t].most, way.cost) << compiled.module->tasks[t].name;
      ++bounded;
      close += counts[t].most * 5 >= way.cost * 4 ? 1 : 0;
    }
  }
  EXPECT_GT(bounded, 20u);
  EXPECT_GT(close, bounded / 4);
}

} // namespace
} // namespace rung::truth
