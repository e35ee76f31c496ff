// Numbers that many branches load, as timers do the time that has passed: written above them, between them, and
// nowhere.
#include <gtest/gtest.h>

#include <random>

#include "ir/transforms/pipeline.h"
#include "tests/differential/optimised_code.h"
#include "tests/support/long_run.h"

namespace rung {
namespace {

using compiler::EngineKind;
using namespace ir;

constexpr SpaceId kWords{0};
constexpr SpaceId kBits{1};
constexpr uint32_t kAmounts = 3; // the numbers that branches load
constexpr uint32_t kWordCount = 20;
constexpr uint32_t kBitCount = 32;
constexpr uint32_t kRungs = 60;

struct Shape {
  bool writes = false; // some rungs write such a number
  bool exits = false;  // some rungs jump ahead or end the run
};

// The same seed gives the same module.
class Generator {
public:
  Generator(uint64_t seed, const Shape& shape) : random_(seed), shape_(shape) {}

  Module module() {
    Module m = testing::oneTask("loads");
    m.spaces.push_back({.name = "W", .unitBytes = 4, .units = kAmounts + kWordCount + 1});
    m.spaces.push_back({.name = "B", .unitBytes = 1, .units = kBitCount / 8});
    m.inits.push_back({kWords, 0, {1, 0, 0, 0, 2, 0, 0, 128, 3, 0, 0, 0}});
    m.routines[0].rungs.resize(kRungs);
    for (uint32_t i = 0; i < kRungs; ++i) {
      RungBuilder b(m, m.routines[0].rungs[i]);
      if (i == 0)
        inputs(b);
      else
        fill(b, m.routines[0].rungs[i], i);
    }
    return m;
  }

private:
  uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
  Place amount() { return {kWords, 4 * below(kAmounts), 0}; }
  Place word() { return {kWords, 4 * (kAmounts + below(kWordCount)), 0}; }
  Place bit() {
    const uint32_t n = below(kBitCount);
    return {kBits, n / 8, n % 8};
  }

  void inputs(RungBuilder& b) {
    const ValueId now = testing::nextNumber(b, {kWords, 4 * (kAmounts + kWordCount), 0});
    for (uint32_t n = 0; n < kBitCount; ++n)
      b.store({kBits, n / 8, n % 8}, b.zextOrTrunc(Type::Bit, b.shrU(now, b.i32(static_cast<int32_t>(n)))));
    if (below(2) == 0) b.store(amount(), now);
  }

  void fill(RungBuilder& b, Rung& rung, uint32_t number) {
    b.when(b.load(Type::Bit, bit()), [&] {
      const Place to = word();
      b.store(to, b.sub(b.load(Type::I32, to), b.load(Type::I32, amount())));
    });
    if (shape_.writes && below(12) == 0)
      b.when(b.load(Type::Bit, bit()), [&] { b.store(amount(), b.load(Type::I32, word())); });
    if (!shape_.exits || below(12) != 0 || number + 2 >= kRungs) return;
    rung.transfer.cond = b.load(Type::Bit, bit());
    rung.transfer.kind = below(3) == 0 ? TransferKind::End : TransferKind::Goto;
    if (rung.transfer.kind == TransferKind::Goto) rung.transfer.target = number + 1 + below(kRungs - number - 1);
  }

  std::mt19937_64 random_;
  Shape shape_;
};

class SharedLoads : public ::testing::TestWithParam<EngineKind> {};

TEST_P(SharedLoads, AreThoseOfTheInterpreter) {
  const uint64_t seeds = GetParam() == EngineKind::Jit ? testing::howMany(20, 80) : testing::howMany(2, 6);
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    Module module = Generator(seed, {.writes = seed % 2 == 0, .exits = seed % 3 == 0}).module();
    runPasses(module, {});
    testing::expectLikeInterpreter(testing::compiledFrom(std::move(module), {}), GetParam(), seed, 12);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, SharedLoads, testing::optimisingEngines(), testing::engineName);

} // namespace
} // namespace rung
