// Chunks that rest: a program that leaves them out does what one does that runs them all, whoever writes when.
#include <gtest/gtest.h>

#include <memory>

#include "ir/interp/interp.h"
#include "ir/random/random.h"
#include "ir/random/random_source.h"
#include "rtlib/host/compare.h"
#include "rtlib/host/instance.h"
#include "rtlib/nc/names/names.h"

namespace rung::ir {
namespace {

class Counter final : public RungObserver {
public:
  explicit Counter(uint64_t& count) : count_(count) {}
  void rungRan(uint32_t, std::span<const uint64_t>) override { ++count_; }

private:
  uint64_t& count_;
};

// The interpreter's own table says that everything runs.
struct Running {
  Running(const Layout& layout, bool active) : engine(layout, 0), program(engine.program()) {
    engine.setObserver(std::make_unique<Counter>(rungs));
    if (active) program.activity_count = program.chunk_count;
    instance = std::make_unique<host::Instance>(host::Runnable{program, engine.context()});
  }
  uint64_t rungs = 0;
  InterpEngine engine;
  rung_program program;
  std::unique_ptr<host::Instance> instance;
};

struct Ran {
  uint64_t all = 0;
  uint64_t active = 0;
};

// Most scans come without a change, so that there is time to rest.
Ran compareScans(const Module& module, uint64_t seed) {
  const Layout layout(module, {.maxChunkRungs = 1 + static_cast<uint32_t>(seed % 3)});
  Running all(layout, false);
  Running active(layout, true);
  RandomSource random(seed);
  for (int scan = 0; scan < 120; ++scan) {
    const uint32_t space = random.below(static_cast<uint32_t>(module.spaces.size()));
    const uint32_t byte = random.below(module.spaces[space].unitBytes * module.spaces[space].units);
    const auto value = static_cast<uint8_t>(random.next());
    const bool writes = random.chance(20);
    for (Running* running : {&all, &active}) {
      if (writes) running->instance->memory().writeByte(space, byte, value);
      running->instance->scan();
    }
    const auto difference = host::firstDifference(*all.instance, *active.instance, nc::describe);
    EXPECT_FALSE(difference) << "scan " << scan << ": " << *difference;
    if (difference) break;
  }
  return {all.rungs, active.rungs};
}

TEST(Activity, ARandomProgramDoesTheSame) {
  Ran sum;
  for (uint64_t seed = 0; seed < 300 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Module module = randomModule(seed, {.rungs = 24, .ops = 8, .host = seed % 2 == 0});
    module.activity = true;
    const Ran ran = compareScans(module, seed);
    sum.all += ran.all;
    sum.active += ran.active;
  }
  EXPECT_LT(sum.active, sum.all / 10 * 9) << "hardly anything rested, so nothing was tested";
}

} // namespace
} // namespace rung::ir
