// Ranges of values: the result of every operation lies in the range that is made of its operands' ranges.
#include "ir/analysis/value_range.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"

#include <gtest/gtest.h>

#include <random>

namespace rung::ir {
namespace {

constexpr Type kTypes[] = {Type::Bit, Type::I8, Type::I16, Type::I32, Type::I64};

class Numbers {
public:
  // Small ones, those near the ends of the type and near its sign, and any.
  uint64_t number(Type type) {
    const uint64_t mask = valueMask(type);
    const uint64_t small = any_() % 12;
    switch (any_() % 4) {
    case 0: return small & mask;
    case 1: return (mask - small) & mask;
    case 2: return ((mask >> 1) + 6 - small) & mask;
    default: return any_() & mask;
    }
  }
  Range range(Type type) {
    const uint64_t a = number(type);
    const uint64_t b = any_() % 3 == 0 ? a : number(type);
    return {std::min(a, b), std::max(a, b)};
  }
  uint64_t within(const Range& range) {
    const uint64_t size = range.high - range.low;
    if (any_() % 4 == 0) return range.low;
    if (any_() % 4 == 0) return range.high;
    return size == ~0ull ? any_() : range.low + any_() % (size + 1);
  }
  Type type() { return kTypes[any_() % std::size(kTypes)]; }

private:
  std::mt19937_64 any_{1};
};

// The type of an operand; None where there is none for this T.
Type operandOf(Numbers& numbers, Constraint constraint, Type own) {
  if (constraint == Constraint::Same) return own;
  if (constraint == Constraint::Bit) return Type::Bit;
  if (constraint == Constraint::I32) return Type::I32;
  for (int tries = 0; tries < 50; ++tries)
    if (const Type type = numbers.type(); satisfies(constraint, own, type)) return type;
  return Type::None;
}

TEST(ValueRange, HoldsEveryResult) {
  Numbers numbers;
  for (const OpInfo& info : allOps()) {
    if (!isEvaluable(info)) continue;
    for (int i = 0; i < 20'000; ++i) {
      const Type type = numbers.type();
      if (!contains(info.types, type) || resultType(info.result, type) == Type::F64) continue;
      Type types[3] = {type, type, type};
      Range ranges[3];
      bool possible = true;
      for (int k = 0; k < info.fixed; ++k) {
        types[k] = operandOf(numbers, info.operands[static_cast<size_t>(k)], type);
        possible = possible && types[k] != Type::None;
        ranges[k] = possible ? numbers.range(types[k]) : Range{};
      }
      if (!possible) continue;
      const Range result = rangeOf(info, type, types[0], ranges);
      ASSERT_LE(result.low, result.high) << info.name;
      for (int n = 0; n < 8; ++n) {
        uint64_t args[3];
        for (int k = 0; k < 3; ++k) args[k] = numbers.within(ranges[k]);
        const uint64_t value = evalPure(info.code, type, types[0], args);
        ASSERT_TRUE(result.low <= value && value <= result.high)
            << info.name << " " << typeName(type) << " of [" << ranges[0].low << ", " << ranges[0].high << "] and ["
            << ranges[1].low << ", " << ranges[1].high << "]: " << value << " is not in [" << result.low << ", "
            << result.high << "]";
      }
    }
  }
}

Range of(OpCode code, Type type, Range a, Range b = {}) {
  const Range args[3] = {a, b, {}};
  return rangeOf(opInfo(code), type, type, args);
}

TEST(ValueRange, SumsThatWrapInAllCasesOrInNone) {
  EXPECT_EQ(of(OpCode::Add, Type::I32, {0, 1}, {932, 932}), (Range{932, 933}));
  EXPECT_EQ(of(OpCode::Add, Type::I32, {932, 933}, {0xFFFFFC5C, 0xFFFFFC5C}), (Range{0, 1}));
  EXPECT_EQ(of(OpCode::Add, Type::I8, {0, 250}, {6, 6}), wholeRange(Type::I8));
  EXPECT_EQ(of(OpCode::Sub, Type::I8, {5, 7}, {5, 5}), (Range{0, 2}));
  EXPECT_EQ(of(OpCode::Sub, Type::I8, {0, 1}, {2, 2}), (Range{254, 255}));
}

TEST(ValueRange, ComparisonsThatAreKnown) {
  EXPECT_EQ(of(OpCode::LtU, Type::I32, {0, 1}, {32, 32}), (Range{1, 1}));
  EXPECT_EQ(of(OpCode::LeU, Type::I32, {10, 12}, {0, 9}), (Range{0, 0}));
  EXPECT_EQ(of(OpCode::LtS, Type::I8, {0x80, 0xFF}, {0, 5}), (Range{1, 1})) << "negative ones";
  EXPECT_EQ(of(OpCode::LtS, Type::I8, {0x7F, 0x80}, {0, 5}), (Range{0, 1})) << "of both signs";
  EXPECT_EQ(of(OpCode::Ne, Type::I32, {0, 1}, {2, 2}), (Range{1, 1}));
}

} // namespace
} // namespace rung::ir
