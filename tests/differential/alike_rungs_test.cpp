// Rows of alike rungs, which optimised code does as vectors: over places that overlap, so that a rung reads what one
// above it or below it writes.
#include <gtest/gtest.h>

#include <random>

#include "ir/chunks/alike_rungs.h"
#include "ir/core/ops.h"
#include "ir/passes/pipeline.h"
#include "tests/differential/optimised_code.h"

namespace rung {
namespace {

using compiler::EngineKind;
using namespace ir;

constexpr SpaceId kBits{0};
constexpr SpaceId kWords{1};
constexpr SpaceId kReals{2};
constexpr uint32_t kBitCount = 192;
constexpr uint32_t kWordCount = 64; // and one behind them, which changes from scan to scan
constexpr uint32_t kRealCount = 64;
constexpr uint32_t kLongest = 40;

// The same seed gives the same module.
class Generator {
public:
  explicit Generator(uint64_t seed) : random_(seed) {}

  Module module() {
    Module m = testing::oneTask("rows");
    m.spaces.push_back({.name = "B", .unitBytes = 1, .units = kBitCount / 8});
    m.spaces.push_back({.name = "W", .unitBytes = 4, .units = kWordCount + 1});
    m.spaces.push_back({.name = "R", .unitBytes = 8, .units = kRealCount});
    std::vector<Rung>& rungs = m.routines[0].rungs;
    inputs(m, rungs.emplace_back());
    for (uint32_t array = 0; array < 8; ++array) {
      const Row row = draw();
      for (uint32_t i = 0; i < row.length; ++i) fill(m, rungs.emplace_back(), row, i);
    }
    return m;
  }

private:
  // Where the rungs of a row read or write: from there on, each one further, or all the same place.
  struct Operand {
    uint32_t from = 0;
    bool isArray = false;
  };
  struct Row {
    uint32_t kind = 0;
    uint32_t length = 0;
    Operand a, b, c, to;
    OpCode code{}, other{};
  };

  uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
  Row draw() {
    constexpr OpCode kBitwise[] = {OpCode::And, OpCode::Or, OpCode::Xor};
    constexpr OpCode kArithmetic[] = {OpCode::Add, OpCode::Sub, OpCode::Mul};
    Row row{.kind = below(4)};
    row.length = 8 + below(kLongest - 8);
    const uint32_t room = (row.kind < 2 ? kBitCount : kWordCount) - kLongest;
    const auto operand = [&](uint32_t end) { return Operand{below(end), below(4) != 0}; };
    row.a = operand(room);
    row.b = operand(room);
    row.c = operand(kBitCount - kLongest);
    row.to = {below(room), true};
    const bool near = below(3) == 0; // rungs read what those just above wrote
    if (near) row.a = {row.to.from + below(3), true};
    row.code = row.kind < 2 ? kBitwise[below(3)] : kArithmetic[below(3)];
    row.other = kBitwise[below(3)];
    return row;
  }

  static Place bit(const Operand& operand, uint32_t i) {
    const uint32_t n = operand.from + (operand.isArray ? i : 0);
    return {kBits, n / 8, n % 8};
  }
  static Place cell(SpaceId space, uint32_t bytes, const Operand& operand, uint32_t i) {
    return {space, bytes * (operand.from + (operand.isArray ? i : 0)), 0};
  }

  static void fill(Module& m, Rung& rung, const Row& row, uint32_t i) {
    RungBuilder b(m, rung);
    if (row.kind < 2) {
      const ValueId left = b.load(Type::Bit, bit(row.a, i));
      const ValueId right = b.load(Type::Bit, bit(row.b, i));
      const ValueId joined = b.binary(row.code, left, row.kind == 0 ? right : b.not_(right));
      return b.store(bit(row.to, i), b.binary(row.other, joined, b.load(Type::Bit, bit(row.c, i))));
    }
    const bool real = row.kind == 2;
    const SpaceId space = real ? kReals : kWords;
    const Type type = real ? Type::F64 : Type::I32;
    const uint32_t bytes = real ? 8 : 4;
    const auto load = [&](const Operand& from) { return b.load(type, cell(space, bytes, from, i)); };
    const auto calculate = [&] {
      const OpCode realOf = row.code == OpCode::Add   ? OpCode::FAdd
                            : row.code == OpCode::Sub ? OpCode::FSub
                                                      : OpCode::FMul;
      const ValueId left = load(row.a);
      b.store(cell(space, bytes, row.to, i), b.binary(real ? realOf : row.code, left, load(row.b)));
    };
    if (row.other == OpCode::And) return b.when(b.load(Type::Bit, bit(row.c, i)), calculate);
    calculate();
  }

  // Some bits are new in each scan, and a word and a real.
  static void inputs(Module& m, Rung& rung) {
    RungBuilder b(m, rung);
    const Place state{kWords, 4 * kWordCount, 0};
    const ValueId now = testing::nextNumber(b, state);
    b.store({kWords, 4 * 7, 0}, now);
    b.store({kReals, 8 * 5, 0}, b.intToF(b.sextOrTrunc(Type::I64, now)));
    for (uint32_t n = 0; n < kBitCount / 8; ++n)
      b.store({kBits, n, 3}, b.zextOrTrunc(Type::Bit, b.shrU(now, b.i32(n + 8))));
  }

  std::mt19937_64 random_;
};

class AlikeRungs : public ::testing::TestWithParam<EngineKind> {};

TEST_P(AlikeRungs, AreThoseOfTheInterpreter) {
  const uint64_t seeds = GetParam() == EngineKind::Jit ? 100 : 6;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    Module module = Generator(seed).module();
    runPasses(module, {});
    LayoutOptions layout;
    layout.expandBits = seed % 3 != 2;
    const compiler::Compiled program = testing::compiledFrom(std::move(module), layout);
    ASSERT_TRUE(hasAlikeRungs(*program.module, program.layout->cut().chunks()[0]));
    testing::expectLikeInterpreter(program, GetParam(), seed, 12);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, AlikeRungs, testing::optimisingEngines(), testing::engineName);

} // namespace
} // namespace rung
