// Contacts in series and parallel with negations anywhere, whose result is a coil, several coils, or asked: optimised
// code has many paths to do these.
#include <gtest/gtest.h>

#include <random>

#include "ir/core/ops.h"
#include "ir/transforms/pipeline.h"
#include "tests/differential/optimised_code.h"
#include "tests/support/long_run.h"

namespace rung {
namespace {

using compiler::EngineKind;
using namespace ir;

constexpr SpaceId kBits{0};
constexpr SpaceId kWords{1};
constexpr uint32_t kInputs = 16;
constexpr uint32_t kCoils = 48;
constexpr uint32_t kRungs = 80;

// The same seed gives the same module.
class Generator {
public:
  explicit Generator(uint64_t seed) : random_(seed) {}

  Module module() {
    Module m = testing::oneTask("logic");
    m.spaces.push_back({.name = "B", .unitBytes = 1, .units = (kInputs + kCoils) / 8});
    m.spaces.push_back({.name = "W", .unitBytes = 4, .units = 2});
    std::vector<Rung>& rungs = m.routines[0].rungs;
    inputs(m, rungs.emplace_back());
    for (uint32_t i = 0; i < kRungs; ++i) fill(m, rungs.emplace_back());
    return m;
  }

private:
  uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }

  static Place bit(uint32_t n) { return {kBits, n / 8, n % 8}; }
  Place coil() { return bit(kInputs + below(kCoils)); }

  ValueId logic(RungBuilder& b, uint32_t depth) {
    const ValueId found =
        depth == 0 || below(4) == 0 ? b.load(Type::Bit, bit(below(kInputs + kCoils))) : joined(b, depth);
    return below(3) == 0 ? b.not_(found) : found;
  }
  ValueId joined(RungBuilder& b, uint32_t depth) {
    constexpr OpCode kBy[] = {OpCode::And, OpCode::And, OpCode::Or, OpCode::Or, OpCode::Xor};
    const ValueId left = logic(b, depth - 1);
    return b.binary(kBy[below(5)], left, logic(b, depth - 1));
  }

  void fill(Module& m, Rung& rung) {
    RungBuilder b(m, rung);
    const ValueId result = logic(b, 1 + below(3));
    switch (below(5)) {
    case 0: return b.when(result, [&] { b.store(coil(), b.load(Type::Bit, coil())); });
    case 1: return count(b, result);
    case 2: b.store(coil(), result); [[fallthrough]];
    default: b.store(coil(), result);
    }
  }
  static void count(RungBuilder& b, ValueId result) {
    const Place counter{kWords, 4, 0};
    const ValueId now = b.load(Type::I32, counter);
    b.store(counter, b.select(result, b.add(now, b.i32(1)), now));
  }

  // All are new in each scan.
  static void inputs(Module& m, Rung& rung) {
    RungBuilder b(m, rung);
    const Place state{kWords, 0, 0};
    const ValueId now = testing::nextNumber(b, state);
    for (uint32_t n = 0; n < kInputs; ++n) b.store(bit(n), b.zextOrTrunc(Type::Bit, b.shrU(now, b.i32(n + 8))));
  }

  std::mt19937_64 random_;
};

class BitLogic : public ::testing::TestWithParam<EngineKind> {};

TEST_P(BitLogic, IsThatOfTheInterpreter) {
  const uint64_t seeds = GetParam() == EngineKind::Jit ? testing::howMany(20, 60) : testing::howMany(3, 10);
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    Module module = Generator(seed).module();
    runPasses(module, {});
    LayoutOptions layout;
    layout.expandBits = seed % 3 != 2;
    const compiler::Compiled program = testing::compiledFrom(std::move(module), layout);
    testing::expectLikeInterpreter(program, GetParam(), seed, 60);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, BitLogic, testing::optimisingEngines(), testing::engineName);

} // namespace
} // namespace rung
