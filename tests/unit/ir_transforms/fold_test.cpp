// Folding: constants, algebra, known branches and transfers.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "ir/transforms/passes.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

// The rung that makes a value by `lines` from %0, %1 (of `type`), %2, %3 (bits) and stores it, folded and without what
// is dead then. The value is the last one.
std::string folded(std::string_view type, std::string_view lines, std::string_view resultType) {
  std::string text = fmt::format(
      "%0:{0} = load D[0]\n%1:{0} = load D[4]\n%2:bit = load B[0.0]\n%3:bit = load B[0.1]\n{1}\n", type, lines);
  const std::string_view last = std::string_view(text).substr(text.rfind('%', text.rfind(':')));
  text += fmt::format("store.{0} D[8{1}], {2}\n", resultType, resultType == "bit" ? ".0" : "",
                      last.substr(0, last.find(':')));
  Module module = moduleOf(text);
  if (module.routines.empty()) return "no module";
  foldConstants(module);
  removeDeadOps(module);
  return bodyOf(module);
}

struct Rule {
  const char* type; // of the operands
  const char* lines;
  const char* resultType;
  const char* expected; // all that is left, but for the store
};

constexpr const char* kX = "%0:i32 = load D[0]\n";
constexpr const char* kP = "%0:bit = load B[0.0]\n";

const Rule kRules[] = {
    // constants, by the one evaluator
    {"i32", "%4:i32 = const 7\n%5:i32 = const 0\n%6:i32 = div_s %4, %5", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = const -2147483648\n%5:i32 = const -1\n%6:i32 = div_s %4, %5", "i32",
     "%0:i32 = const -2147483648\n"},
    {"i32", "%4:i32 = const -1\n%5:i64 = sext %4", "i64", "%0:i64 = const -1\n"},
    {"i32", "%4:bit = const 1\n%5:i16 = sext %4", "i16", "%0:i16 = const -1\n"},
    {"i32", "%4:f64 = const 0\n%5:f64 = fdiv %4, %4", "f64", "%0:f64 = const bits(0x7FF8000000000000)\n"},
    // and, or, xor
    {"i32", "%4:i32 = and %0, %0", "i32", kX},
    {"i32", "%4:i32 = const -1\n%5:i32 = and %4, %0", "i32", kX},
    {"i32", "%4:i32 = const 0\n%5:i32 = and %0, %4", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:bit = not %2\n%5:bit = and %4, %2", "bit", "%0:bit = const 0\n"},
    {"i32", "%4:bit = not %2\n%5:bit = or %2, %4", "bit", "%0:bit = const 1\n"},
    {"i32", "%4:bit = or %2, %3\n%5:bit = and %2, %4", "bit", kP},
    {"i32", "%4:bit = and %3, %2\n%5:bit = or %4, %2", "bit", kP},
    {"i32", "%4:bit = and %2, %3\n%5:bit = and %4, %3", "bit",
     "%0:bit = load B[0.0]\n%1:bit = load B[0.1]\n%2:bit = and %0, %1\n"},
    {"i32", "%4:i32 = xor %0, %0", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = not %0\n%5:i32 = xor %0, %4", "i32", "%0:i32 = const -1\n"},
    {"i32", "%4:bit = const 1\n%5:bit = xor %4, %2", "bit", "%0:bit = load B[0.0]\n%1:bit = not %0\n"},
    // sums with constants
    {"i32", "%4:i32 = const 5\n%5:i32 = add %0, %4\n%6:i32 = const -5\n%7:i32 = add %5, %6", "i32", kX},
    {"i32", "%4:i32 = const 5\n%5:i32 = add %4, %0\n%6:i32 = const 2147483646\n%7:i32 = add %6, %5", "i32",
     "%0:i32 = load D[0]\n%1:i32 = const -2147483645\n%2:i32 = add %0, %1\n"},
    // not
    {"i32", "%4:i32 = not %0\n%5:i32 = not %4", "i32", kX},
    {"i32", "%4:bit = lt_s.i32 %0, %1\n%5:bit = not %4", "bit",
     "%0:i32 = load D[0]\n%1:i32 = load D[4]\n%2:bit = le_s.i32 %1, %0\n"},
    {"i32", "%4:bit = eq.i32 %0, %1\n%5:bit = not %4", "bit",
     "%0:i32 = load D[0]\n%1:i32 = load D[4]\n%2:bit = ne.i32 %0, %1\n"},
    {"f64", "%4:bit = flt.f64 %0, %1\n%5:bit = not %4", "bit",
     "%0:f64 = load D[0]\n%1:f64 = load D[4]\n%2:bit = flt.f64 %0, %1\n%3:bit = not %2\n"},
    // arithmetic
    {"i32", "%4:i32 = const 0\n%5:i32 = add %4, %0", "i32", kX},
    {"i32", "%4:i32 = const 0\n%5:i32 = sub %0, %4", "i32", kX},
    {"i32", "%4:i32 = const 0\n%5:i32 = sub %4, %0", "i32", "%0:i32 = load D[0]\n%1:i32 = neg %0\n"},
    {"i32", "%4:i32 = sub %0, %0", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = const 1\n%5:i32 = mul %4, %0", "i32", kX},
    {"i32", "%4:i32 = const 0\n%5:i32 = mul %0, %4", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = const 0\n%5:i32 = div_u %0, %4", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = const 1\n%5:i32 = div_s %0, %4", "i32", kX},
    {"i32", "%4:i32 = const -1\n%5:i32 = rem_s %0, %4", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = const -1\n%5:i32 = rem_u %0, %4", "i32",
     "%0:i32 = load D[0]\n%1:i32 = const -1\n%2:i32 = rem_u %0, %1\n"},
    {"i32", "%4:i32 = rem_u %0, %0", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = neg %0\n%5:i32 = neg %4", "i32", kX},
    // shifts
    {"i32", "%4:i32 = const 0\n%5:i32 = shl %0, %4", "i32", kX},
    {"i32", "%4:i32 = const 32\n%5:i32 = shr_u %0, %4", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = const 32\n%5:i32 = shr_s %0, %4", "i32",
     "%0:i32 = load D[0]\n%1:i32 = const 32\n%2:i32 = shr_s %0, %1\n"},
    {"i32", "%4:i32 = const -1\n%5:i32 = shr_s %4, %0", "i32", "%0:i32 = const -1\n"},
    // compares
    {"i32", "%4:bit = eq.i32 %0, %0", "bit", "%0:bit = const 1\n"},
    {"i32", "%4:bit = lt_s.i32 %0, %0", "bit", "%0:bit = const 0\n"},
    {"i32", "%4:bit = le_u.i32 %0, %0", "bit", "%0:bit = const 1\n"},
    {"i32", "%4:i32 = const 0\n%5:bit = lt_u.i32 %0, %4", "bit", "%0:bit = const 0\n"},
    {"i32", "%4:i32 = const 0\n%5:bit = lt_s.i32 %0, %4", "bit",
     "%0:i32 = load D[0]\n%1:i32 = const 0\n%2:bit = lt_s.i32 %0, %1\n"},
    {"i32", "%4:i32 = const -1\n%5:bit = le_u.i32 %0, %4", "bit", "%0:bit = const 1\n"},
    {"i32", "%4:bit = const 1\n%5:bit = eq.bit %2, %4", "bit", kP},
    {"i32", "%4:bit = const 1\n%5:bit = ne.bit %2, %4", "bit", "%0:bit = load B[0.0]\n%1:bit = not %0\n"},
    {"i32", "%4:i32 = zext %2\n%5:i32 = const 0\n%6:bit = ne.i32 %4, %5", "bit", kP},
    {"i32", "%4:i32 = zext %2\n%5:i32 = const 2\n%6:bit = eq.i32 %4, %5", "bit", "%0:bit = const 0\n"},
    {"i32", "%4:i32 = sext %2\n%5:i32 = const 1\n%6:bit = eq.i32 %4, %5", "bit",
     "%0:bit = load B[0.0]\n%1:i32 = sext %0\n%2:i32 = const 1\n%3:bit = eq.i32 %1, %2\n"},
    {"f64", "%4:bit = feq.f64 %0, %0", "bit", "%0:f64 = load D[0]\n%1:bit = feq.f64 %0, %0\n"},
    // select
    {"i32", "%4:bit = const 1\n%5:i32 = select %4, %0, %1", "i32", kX},
    {"i32", "%4:bit = const 0\n%5:i32 = select %4, %1, %0", "i32", kX},
    {"i32", "%4:i32 = select %2, %0, %0", "i32", kX},
    {"i32", "%4:bit = not %2\n%5:i32 = select %4, %0, %1", "i32",
     "%0:i32 = load D[0]\n%1:i32 = load D[4]\n%2:bit = load B[0.0]\n%3:i32 = select %2, %1, %0\n"},
    {"i32", "%4:bit = const 1\n%5:bit = const 0\n%6:bit = select %2, %4, %5", "bit", kP},
    {"i32", "%4:bit = const 0\n%5:bit = select %2, %3, %4", "bit",
     "%0:bit = load B[0.0]\n%1:bit = load B[0.1]\n%2:bit = and %0, %1\n"},
    {"i32", "%4:bit = const 1\n%5:bit = select %2, %4, %3", "bit",
     "%0:bit = load B[0.0]\n%1:bit = load B[0.1]\n%2:bit = or %0, %1\n"},
    // widths
    {"i32", "%4:i64 = sext %0\n%5:i32 = trunc %4", "i32", kX},
    {"i32", "%4:i64 = zext %0\n%5:i16 = trunc %4", "i16", "%0:i32 = load D[0]\n%1:i16 = trunc %0\n"},
    {"i8", "%4:i64 = sext %0\n%5:i16 = trunc %4", "i16", "%0:i8 = load D[0]\n%1:i16 = sext %0\n"},
    {"i8", "%4:i16 = zext %0\n%5:i32 = sext %4", "i32", "%0:i8 = load D[0]\n%1:i32 = zext %0\n"},
    {"i8", "%4:i16 = sext %0\n%5:i32 = zext %4", "i32", "%0:i8 = load D[0]\n%1:i16 = sext %0\n%2:i32 = zext %1\n"},
    // floating point: what is exact, and what is not because of NaN and -0
    {"f64", "%4:f64 = fneg %0\n%5:f64 = fneg %4", "f64", "%0:f64 = load D[0]\n"},
    {"f64", "%4:f64 = fneg %0\n%5:f64 = fabs %4", "f64", "%0:f64 = load D[0]\n%1:f64 = fabs %0\n"},
    {"f64", "%4:f64 = const 0\n%5:f64 = fadd %0, %4", "f64",
     "%0:f64 = load D[0]\n%1:f64 = const 0\n%2:f64 = fadd %0, %1\n"},
    {"f64", "%4:f64 = const 1\n%5:f64 = fmul %0, %4", "f64",
     "%0:f64 = load D[0]\n%1:f64 = const 1\n%2:f64 = fmul %0, %1\n"},
    {"f64", "%4:i64 = f_to_bits %0\n%5:f64 = bits_to_f %4", "f64", "%0:f64 = load D[0]\n"},
    // windows
    {"i32", "%4:i32 = const 2\n%5:i32 = load_at D[3 count 4], %4", "i32", "%0:i32 = load D[5]\n"},
    {"i32", "%4:i32 = const 4\n%5:i32 = load_at D[3 count 4], %4", "i32", "%0:i32 = const 0\n"},
    {"i32", "%4:i32 = const 1\n%5:i32 = const 17\n%6:bit = load_bit_at D[3 count 4], %4, %5", "bit",
     "%0:bit = load D[4.17]\n"},
    {"i32", "%4:i32 = const 1\n%5:i32 = const 32\n%6:bit = load_bit_at D[3 count 4], %4, %5", "bit",
     "%0:bit = const 0\n"},
};

TEST(Fold, Rules) {
  for (const Rule& rule : kRules) {
    const std::string body = folded(rule.type, rule.lines, rule.resultType);
    const size_t store = body.rfind("store");
    EXPECT_EQ(body.substr(0, store), rule.expected) << rule.lines;
  }
}

TEST(Fold, WritesThroughAWindowWithAKnownIndex) {
  EXPECT_EQ(after(foldConstants, R"(%0:i32 = const 3
%1:i32 = const 7
%2:bit = const 1
store_at.i32 D[1 count 4], %0, %1
store_at.i32 D[1 count 3], %0, %1
store_bit_at.bit B[1 count 4], %0, %1, %2
store_bit_at.bit B[1 count 3], %0, %1, %2)"),
            "%0:i32 = const 3\n%1:i32 = const 7\n%2:bit = const 1\nstore.i32 D[4], %1\nstore.bit B[4.7], %2\n");
}

TEST(Fold, TrapsThatNeverHappen) {
  EXPECT_EQ(after(foldConstants, "%0:bit = const 0\ntrap F, %0\n%1:bit = const 1\ntrap F, %1 @7"),
            "%0:bit = const 0\n%1:bit = const 1\ntrap F, %1 @7\n");
}

TEST(Fold, KeepsTheFirstBranch) {
  EXPECT_EQ(after(foldConstants, R"(%0:bit = const 1
%1:i32 = const 5
%2:i32 = load D[9]
if %0
  store.i32 D[0], %1
  if %0
    note "inner"
  endif
else %2
  store.i32 D[1], %1
  %3:bit = load B[0.0]
  if %3
    note "lost"
  endif
%4:i32 = endif %1
store.i32 D[2], %4)"),
            "%0:bit = const 1\n%1:i32 = const 5\n%2:i32 = load D[9]\nstore.i32 D[0], %1\nnote \"inner\"\nstore.i32 "
            "D[2], %2\n");
}

TEST(Fold, KeepsTheSecondBranch) {
  EXPECT_EQ(after(foldConstants, R"(%0:bit = const 0
note "before"
if %0
  note "lost"
  %1:bit = load B[0.0]
  if %1
    note "lost too"
  else
    note "and this"
  endif
else %0
  note "kept"
  %2:bit = load B[0.1]
%3:bit = endif %2
store.bit B[1.0], %3)"),
            "%0:bit = const 0\nnote \"before\"\nnote \"kept\"\n%1:bit = load B[0.1]\nstore.bit B[1.0], %1\n");
  EXPECT_EQ(after(foldConstants, "%0:bit = const 0\nif %0\n  note \"lost\"\nendif\nnote \"kept\""),
            "%0:bit = const 0\nnote \"kept\"\n");
}

TEST(Fold, AYieldOfBothBranchesIsTheValue) {
  EXPECT_EQ(after(foldConstants, R"(%0:bit = load B[0.0]
%1:i32 = load D[0]
if %0
  note "a"
else %1
  note "b"
%2:i32 = endif %1
store.i32 D[1], %2)"),
            "%0:bit = load B[0.0]\n%1:i32 = load D[0]\nif %0\nnote \"a\"\nelse %1\nnote \"b\"\n%2:i32 = endif "
            "%1\nstore.i32 D[1], %1\n");
}

TEST(Fold, LoopsOfNoPassAndOfOne) {
  EXPECT_EQ(after(foldConstants, R"(%0:i32 = load D[0]
%1:i32, %2:i32 = loop 0, %0
  note "never"
  %3:i32 = add %1, %2
%4:i32 = endloop %3
store.i32 D[1], %4)"),
            "%0:i32 = load D[0]\nstore.i32 D[1], %0\n");
  EXPECT_EQ(after(foldConstants, R"(%0:i32 = load D[0]
%1:i32, %2:i32 = loop 1, %0
  %3:i32 = add %1, %2
  %4:i32 = mul %2, %2
%5:i32 = endloop %4
store.i32 D[1], %5)"),
            "%0:i32 = load D[0]\n%1:i32 = const 0\n%2:i32 = mul %0, %0\nstore.i32 D[1], %2\n");
}

TEST(Fold, Transfers) {
  EXPECT_EQ(after(foldConstants, "%0:bit = const 0", "} goto 2 if %0 @4"), "%0:bit = const 0\n} @4\n");
  EXPECT_EQ(after(foldConstants, "%0:bit = const 1", "} goto 2 if %0"), "%0:bit = const 1\n} goto 2\n");
  EXPECT_EQ(after(foldConstants, "%0:bit = const 1", "} call Q if %0"), "%0:bit = const 1\n} call Q\n");
  EXPECT_EQ(after(foldConstants, "%0:bit = const 0", "} call Q if %0"), "%0:bit = const 0\n");
  EXPECT_EQ(after(foldConstants, "%0:bit = load B[0.0]", "} goto 1 if %0"), "%0:bit = load B[0.0]\n");
  EXPECT_EQ(after(foldConstants, "%0:i32 = const 1", "} switch %0 [2, 3]"), "%0:i32 = const 1\n} goto 3\n");
  EXPECT_EQ(after(foldConstants, "%0:i32 = const -1", "} switch %0 [2, 3]"), "%0:i32 = const -1\n} goto 2\n");
}

} // namespace
} // namespace rung::ir
