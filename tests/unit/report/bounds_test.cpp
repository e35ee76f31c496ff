// Bounds in steps against what runs take in the interpreter.
#include "tests/unit/report/bounds_testing.h"
#include "tools/report/wcet_step_counter.h"

namespace rung::report {
namespace {

std::vector<StepCounter::Count> countSteps(const compiler::Compiled& compiled, int scans) {
  StepCounter counter(compiled.module->tasks.size());
  compiler::EngineOptions options;
  options.observer = [&](const compiler::Compiled& of) { return counter.observer(of.layout->partition()); };
  const std::unique_ptr<runtime::Engine> engine = engineOf(compiler::EngineKind::Interp, compiled, options);
  runtime::Instance instance(*engine);
  instance.setTaskWatch(&counter);
  ir::RandomSource random(7);
  for (int i = 0; i < scans; ++i) {
    if (instance.faulted()) instance.coldStart();
    scatter(instance, random);
    instance.scan();
  }
  return counter.counts();
}

TEST(Steps, AreNeverMoreThanTheBound) {
  uint32_t reached = 0;
  uint32_t bounded = 0;
  for (uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    const compiler::Compiled compiled = randomProgram(seed, {.ops = 6});
    const std::vector<StepCounter::Count> counts = countSteps(compiled, 12);
    const ir::Partition& cut = compiled.layout->partition();
    for (uint32_t t = 0; t < compiled.module->tasks.size(); ++t) {
      const ir::LongestPath way = ir::longestPath(cut, ir::TaskId{t}, ir::rungWeights(cut));
      if (!way.loops.empty()) continue;
      EXPECT_LE(counts[t].most, way.cost);
      ++bounded;
      reached += counts[t].most == way.cost ? 1 : 0;
    }
  }
  EXPECT_GT(bounded, 50u);
  EXPECT_GT(reached, bounded / 4); // the bound is not only large
}

TEST(Stretches, JoinNumbersThatFollowOneAnother) {
  EXPECT_EQ(stretches({3, 4, 5, 5, 9, 10, 7}), (std::vector<Stretch>{{3, 5}, {9, 10}, {7, 7}}));
  EXPECT_TRUE(stretches({}).empty());
}

} // namespace
} // namespace rung::report
