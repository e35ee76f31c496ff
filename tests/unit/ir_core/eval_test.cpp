// The evaluator of operations without effects, against a model in 128-bit arithmetic that shares nothing with it.
#include <gtest/gtest.h>

#include "ir/core/eval.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "rung/sem.hpp"
#include "tests/random/random.h"

namespace rung::ir {
namespace {

__extension__ using Wide = __int128;

uint64_t eval(OpCode code, Type type, Type first, std::initializer_list<uint64_t> args) {
  uint64_t operands[4] = {};
  std::copy(args.begin(), args.end(), operands);
  return evalPure(code, type, first, operands);
}

constexpr Type kIntTypes[] = {Type::I8, Type::I16, Type::I32, Type::I64};

Wide signedOf(Type type, uint64_t bits) {
  const uint32_t width = bitWidth(type);
  return (bits >> (width - 1) & 1) != 0 ? Wide{bits} - (Wide{1} << width) : Wide{bits};
}
uint64_t wrap(Type type, Wide value) { return static_cast<uint64_t>(value) & valueMask(type); }

TEST(Eval, IntegersOfEveryWidth) {
  for (Type type : kIntTypes)
    for (uint64_t a : boundaryValues(type))
      for (uint64_t b : boundaryValues(type)) {
        SCOPED_TRACE(::testing::Message() << typeName(type) << " " << a << " " << b);
        const Wide sa = signedOf(type, a);
        const Wide sb = signedOf(type, b);
        const auto is = [&](OpCode code, uint64_t wanted) {
          EXPECT_EQ(eval(code, type, type, {a, b}), wanted) << opInfo(code).name;
        };
        is(OpCode::Add, wrap(type, sa + sb));
        is(OpCode::Sub, wrap(type, sa - sb));
        is(OpCode::Mul, wrap(type, sa * sb));
        is(OpCode::DivS, b == 0 ? 0 : wrap(type, sa / sb));
        is(OpCode::RemS, b == 0 ? 0 : wrap(type, sa % sb));
        is(OpCode::DivU, b == 0 ? 0 : a / b);
        is(OpCode::RemU, b == 0 ? 0 : a % b);
        is(OpCode::And, a & b);
        is(OpCode::Or, a | b);
        is(OpCode::Xor, a ^ b);
        is(OpCode::Eq, a == b);
        is(OpCode::Ne, a != b);
        is(OpCode::LtS, sa < sb);
        is(OpCode::LeS, sa <= sb);
        is(OpCode::LtU, a < b);
        is(OpCode::LeU, a <= b);
        EXPECT_EQ(eval(OpCode::Not, type, type, {a}), valueMask(type) - a);
        EXPECT_EQ(eval(OpCode::Neg, type, type, {a}), wrap(type, -sa));
      }
}

TEST(Eval, Shifts) {
  for (Type type : kIntTypes)
    for (uint64_t a : boundaryValues(type))
      for (uint64_t count : boundaryCounts()) {
        const auto n = static_cast<uint32_t>(count);
        const uint32_t width = bitWidth(type);
        EXPECT_EQ(eval(OpCode::Shl, type, type, {a, n}), n >= width ? 0 : a << n & valueMask(type)) << a << " " << n;
        EXPECT_EQ(eval(OpCode::ShrU, type, type, {a, n}), n >= width ? 0 : a >> n) << a << " " << n;
        EXPECT_EQ(eval(OpCode::ShrS, type, type, {a, n}), wrap(type, signedOf(type, a) >> std::min(n, width - 1)))
            << a << " " << n;
      }
}

TEST(Eval, Bits) {
  for (uint64_t a : {0u, 1u}) {
    EXPECT_EQ(eval(OpCode::Not, Type::Bit, Type::Bit, {a}), 1 - a);
    for (uint64_t b : {0u, 1u}) {
      EXPECT_EQ(eval(OpCode::And, Type::Bit, Type::Bit, {a, b}), a * b);
      EXPECT_EQ(eval(OpCode::Or, Type::Bit, Type::Bit, {a, b}), a + b > 0);
      EXPECT_EQ(eval(OpCode::Xor, Type::Bit, Type::Bit, {a, b}), (a + b) % 2);
      EXPECT_EQ(eval(OpCode::Eq, Type::Bit, Type::Bit, {a, b}), a == b);
      EXPECT_EQ(eval(OpCode::Select, Type::I64, Type::Bit, {a, 5, 7}), a == 1 ? 5 : 7);
    }
  }
}

TEST(Eval, Widths) {
  EXPECT_EQ(eval(OpCode::ZExt, Type::I32, Type::I8, {0x80}), 0x80u);
  EXPECT_EQ(eval(OpCode::SExt, Type::I32, Type::I8, {0x80}), 0xFFFFFF80u);
  EXPECT_EQ(eval(OpCode::SExt, Type::I32, Type::I8, {0x7F}), 0x7Fu);
  EXPECT_EQ(eval(OpCode::SExt, Type::I64, Type::I32, {0x80000000}), 0xFFFFFFFF80000000u);
  EXPECT_EQ(eval(OpCode::SExt, Type::I16, Type::Bit, {1}), 0xFFFFu);
  EXPECT_EQ(eval(OpCode::SExt, Type::I16, Type::Bit, {0}), 0u);
  EXPECT_EQ(eval(OpCode::ZExt, Type::I8, Type::Bit, {1}), 1u);
  EXPECT_EQ(eval(OpCode::Trunc, Type::I8, Type::I64, {0x1234567890ABCDEF}), 0xEFu);
  EXPECT_EQ(eval(OpCode::Trunc, Type::Bit, Type::I8, {0xFE}), 0u);
  EXPECT_EQ(eval(OpCode::Trunc, Type::Bit, Type::I8, {0x01}), 1u);
}

TEST(Eval, Floats) {
  const auto f = [](double x) { return sem::toBits(x); };
  EXPECT_EQ(eval(OpCode::FAdd, Type::F64, Type::F64, {f(1.5), f(2)}), f(3.5));
  EXPECT_EQ(eval(OpCode::FSub, Type::F64, Type::F64, {f(1.5), f(2)}), f(-0.5));
  EXPECT_EQ(eval(OpCode::FMul, Type::F64, Type::F64, {f(1.5), f(2)}), f(3));
  EXPECT_EQ(eval(OpCode::FDiv, Type::F64, Type::F64, {f(3), f(2)}), f(1.5));
  EXPECT_EQ(eval(OpCode::FNeg, Type::F64, Type::F64, {f(0)}), f(-0.0));
  EXPECT_EQ(eval(OpCode::FAbs, Type::F64, Type::F64, {f(-2)}), f(2));
  EXPECT_EQ(eval(OpCode::FEq, Type::F64, Type::F64, {f(0), f(-0.0)}), 1u);
  EXPECT_EQ(eval(OpCode::FEq, Type::F64, Type::F64, {sem::kNanBits, sem::kNanBits}), 0u);
  EXPECT_EQ(eval(OpCode::FLt, Type::F64, Type::F64, {f(-1), f(1)}), 1u);
  EXPECT_EQ(eval(OpCode::FLt, Type::F64, Type::F64, {f(1), f(1)}), 0u);
  EXPECT_EQ(eval(OpCode::FLe, Type::F64, Type::F64, {f(1), f(1)}), 1u);
  EXPECT_EQ(eval(OpCode::FLe, Type::F64, Type::F64, {f(1), sem::kNanBits}), 0u);
  EXPECT_EQ(eval(OpCode::FToInt, Type::I16, Type::F64, {f(-70000)}), 0x8000u);
  EXPECT_EQ(eval(OpCode::FToIntNearest, Type::I64, Type::F64, {f(2.5)}), 2u);
  EXPECT_EQ(eval(OpCode::IntToF, Type::F64, Type::I8, {0xFF}), f(-1));
  EXPECT_EQ(eval(OpCode::IntToF, Type::F64, Type::I32, {0xFF}), f(255));
  EXPECT_EQ(eval(OpCode::BitsToF, Type::F64, Type::I64, {0xFFF8000000000001}), 0xFFF8000000000001u);
  EXPECT_EQ(eval(OpCode::FToBits, Type::I64, Type::F64, {0xFFF8000000000001}), 0xFFF8000000000001u);
}

TEST(Eval, DigitsAndOnes) {
  EXPECT_EQ(eval(OpCode::BcdEncode, Type::I16, Type::I16, {1234}), 0x1234u);
  EXPECT_EQ(eval(OpCode::BcdDecode, Type::I32, Type::I32, {0x12345678}), 12345678u);
  EXPECT_EQ(eval(OpCode::PopCount, Type::I8, Type::I8, {0xA5}), 4u);
}

TEST(EvalDeathTest, RefusesWhatHasEffects) {
  EXPECT_DEATH(eval(OpCode::Now, Type::I64, Type::I64, {0}), "can be evaluated");
  EXPECT_DEATH(eval(OpCode::Add, Type::Bit, Type::Bit, {1, 1}), "a type that its row does not have");
}

} // namespace
} // namespace rung::ir
