// Bounds in steps against what runs take in the interpreter.
#include <utility>

#include "ir/chunks/rung_costs.h"
#include "tests/unit/wcet/bounds_testing.h"

namespace rung::wcet {
namespace {

// Of whole runs and of parts, by task.
class MostSteps final : public host::TaskWatch {
public:
  explicit MostSteps(const compiler::Compiled& compiled) : most_(compiled.module->tasks.size(), 0) {}

  class Adder final : public ir::RungObserver {
  public:
    Adder(const ir::Cut& cut, uint64_t& steps) : weights_(ir::rungWeights(cut)), steps_(steps) {}
    void rungRan(uint32_t number, std::span<const uint64_t>) override { steps_ += weights_[number]; }

  private:
    std::vector<uint64_t> weights_;
    uint64_t& steps_;
  };
  std::unique_ptr<ir::RungObserver> adder(const compiler::Compiled& of) {
    return std::make_unique<Adder>(of.layout->cut(), steps_);
  }

  void begins(const host::Instance&, uint32_t) override { steps_ = 0; }
  void ended(const host::Instance&, uint32_t task) override { most_[task] = std::max(most_[task], steps_); }
  uint64_t of(uint32_t task) const { return most_[task]; }

private:
  uint64_t steps_ = 0;
  std::vector<uint64_t> most_;
};

MostSteps mostSteps(const compiler::Compiled& compiled, int scans) {
  MostSteps most(compiled);
  compiler::EngineOptions options;
  options.observer = [&](const compiler::Compiled& of) { return most.adder(of); };
  const std::unique_ptr<host::Engine> engine = engineOf(compiler::EngineKind::Interp, compiled, options);
  host::Instance instance(*engine);
  instance.setTaskWatch(&most);
  ir::RandomSource random(7);
  for (int i = 0; i < scans; ++i) {
    if (instance.faulted()) instance.coldStart();
    scatter(instance, random);
    instance.scan();
  }
  return most;
}

TEST(Steps, AreNeverMoreThanTheBound) {
  uint32_t reached = 0;
  uint32_t bounded = 0;
  for (uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    const compiler::Compiled compiled = randomProgram(seed, {.ops = 6});
    const MostSteps most = mostSteps(compiled, 12);
    const ir::Cut& cut = compiled.layout->cut();
    for (uint32_t t = 0; t < compiled.module->tasks.size(); ++t) {
      const ir::HeaviestWay way = ir::heaviestWay(cut, ir::TaskId{t}, ir::rungWeights(cut));
      if (!way.circles.empty()) continue;
      EXPECT_LE(most.of(t), way.cost);
      ++bounded;
      reached += most.of(t) == way.cost ? 1 : 0;
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
} // namespace rung::wcet
