// Random rungs as control programs have them: flags that each of many instructions writes over those of the one before,
// values that are used far below where they were stored, and stores of what branches give.
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

constexpr SpaceId kWords{0};
constexpr SpaceId kBits{1};
constexpr uint32_t kWordCount = 12;
constexpr uint32_t kBitCount = 40;
constexpr SpaceId kBytes{2};

struct Shape {
  uint32_t rungs = 80;
  bool readers = false; // some rungs look at flags
  bool exits = false;   // some rungs leave the chunk
  bool flags = true;    // else bits alone, mostly without branches
};

// The same seed gives the same module.
class Generator {
public:
  Generator(uint64_t seed, const Shape& shape) : random_(seed), shape_(shape) {}

  Module module() {
    Module m = testing::oneTask("flags");
    m.spaces.push_back({.name = "W", .unitBytes = 4, .units = 16});
    m.spaces.push_back({.name = "B", .unitBytes = 1, .units = 16});
    m.spaces.push_back({.name = "R", .unitBytes = 1, .units = 8});
    m.inits.push_back({kWords, 0, bytes(64)});
    m.routines[0].rungs.resize(shape_.rungs);
    for (uint32_t i = 0; i < shape_.rungs; ++i) {
      RungBuilder b(m, m.routines[0].rungs[i]);
      fill(b, m.routines[0].rungs[i], i);
    }
    return m;
  }

private:
  uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
  std::vector<uint8_t> bytes(uint32_t count) {
    std::vector<uint8_t> out(count);
    for (uint8_t& byte : out) byte = static_cast<uint8_t>(random_());
    return out;
  }
  Place word() { return {kWords, 4 * below(kWordCount), 0}; }
  Place bit() {
    const uint32_t n = below(kBitCount);
    return {kBits, n / 8, n % 8};
  }
  static Place flag(uint32_t n) { return {kBits, 10, n}; }

  void fill(RungBuilder& b, Rung& rung, uint32_t number) {
    if (number == 0) return inputs(b);
    const uint32_t kind = below(10);
    if (kind < 4 && shape_.flags) return arithmetic(b);
    if (below(shape_.flags ? 5 : 40) == 0) return branch(b);
    if (kind == 4 && shape_.readers) return b.store(bit(), b.load(Type::Bit, flag(below(3))));
    if (kind == 5) return b.store(word(), b.add(b.load(Type::I32, word()), b.i32(static_cast<int32_t>(random_()))));
    if (kind == 6) return b.store({kBytes, below(5), 0}, b.load(Type::I8, {kBytes, below(5), 0}));
    logic(b);
    if (!shape_.exits || kind != 7 || number + 2 >= shape_.rungs) return;
    rung.transfer.cond = b.load(Type::Bit, bit());
    rung.transfer.kind = below(2) == 0 ? TransferKind::End : TransferKind::Goto;
    if (rung.transfer.kind == TransferKind::Goto) rung.transfer.target = number + 1 + below(shape_.rungs - number - 1);
  }

  // Some bits are new in each scan.
  static void inputs(RungBuilder& b) {
    const Place cell{kWords, 4 * kWordCount, 0};
    const ValueId now = testing::nextNumber(b, cell);
    for (uint32_t n = 0; n < kBitCount; n += 2)
      b.store({kBits, n / 8, n % 8}, b.zextOrTrunc(Type::Bit, b.shrU(now, b.i32(n / 2 + 8))));
  }

  void logic(RungBuilder& b) {
    ValueId value = b.load(Type::Bit, bit());
    for (uint32_t n = 1 + below(3); n > 0; --n) {
      const ValueId other = b.load(Type::Bit, bit());
      value = below(2) == 0 ? b.and_(value, b.not_(other)) : b.or_(value, other);
    }
    b.store(bit(), value);
    if (below(2) == 0) b.store(bit(), value);
  }

  // The place has been read before what the branches give is stored there.
  void branch(RungBuilder& b) {
    const auto yes = [&] {
      b.store(word(), b.i32(7));
      return b.bit(false);
    };
    const ValueId value = b.choose(b.load(Type::Bit, bit()), yes, [&] { return b.load(Type::Bit, bit()); });
    const Place to = bit();
    b.store(bit(), b.load(Type::Bit, to));
    b.store(to, value);
  }

  void arithmetic(RungBuilder& b) {
    b.when(b.load(Type::Bit, bit()), [&] {
      if (below(4) == 0) b.store(flag(0), b.bit(false)); // of another box before it
      const auto wide = [&] { return b.sextOrTrunc(Type::I64, b.load(Type::I32, word())); };
      constexpr OpCode kOps[] = {OpCode::Add, OpCode::Add, OpCode::Sub, OpCode::Mul, OpCode::DivS};
      const OpCode code = kOps[below(5)];
      const ValueId a = wide();
      const ValueId result = b.binary(code, a, wide());
      const ValueId zero = b.constant(Type::I64, 0);
      const ValueId low = b.zextOrTrunc(Type::I32, result);
      const ValueId over = b.ne(b.sextOrTrunc(Type::I64, low), result);
      const ValueId byte = b.select(b.eq(result, zero), b.constant(Type::I8, 1), b.constant(Type::I8, 0));
      const ValueId sign = b.select(b.ltS(result, zero), b.constant(Type::I8, 2), b.constant(Type::I8, 0));
      b.store({kBytes, 0, 0}, b.or_(byte, sign));
      b.store(flag(0), b.bit(false));
      b.store(flag(1), code == OpCode::Mul ? b.bit(true) : over); // one of them comes about in another way
      b.store(flag(2), b.ltS(zero, result));
      b.store(word(), low);
    });
  }

  std::mt19937_64 random_;
  Shape shape_;
};

class Flags : public ::testing::TestWithParam<EngineKind> {};

TEST_P(Flags, AreThoseOfTheInterpreter) {
  const uint64_t seeds = GetParam() == EngineKind::Jit ? testing::howMany(25, 100) : testing::howMany(3, 6);
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    const Shape shape{.rungs = 80, .readers = seed % 4 == 0, .exits = seed % 3 == 0, .flags = seed % 5 != 0};
    Module module = Generator(seed, shape).module();
    runPasses(module, {});
    LayoutOptions layout;
    layout.expandBits = seed % 4 != 2;
    const compiler::Compiled program = testing::compiledFrom(std::move(module), layout);
    testing::expectLikeInterpreter(program, GetParam(), seed, 12);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, Flags, testing::optimisingEngines(), testing::engineName);

} // namespace
} // namespace rung
