// The arithmetic of the IR: tables at the boundaries, all pairs of bytes against plain arithmetic, and the same
// functions in constant expressions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rung/sem.hpp"

namespace rung::sem {
namespace {

// ---- what a compiler must be able to compute -----------------------------------------------------------------------

static_assert(add<u8>(0xFF, 1) == 0 && add<u64>(~0ull, 2) == 1);
static_assert(sub<u16>(0, 1) == 0xFFFF);
static_assert(mul<u32>(0xFFFFFFFF, 0xFFFFFFFF) == 1);
static_assert(neg<u8>(0x80) == 0x80 && neg<u64>(1) == ~0ull);
static_assert(divS<u8>(0x80, 0xFF) == 0x80 && remS<u8>(0x80, 0xFF) == 0);
static_assert(divS<u64>(1ull << 63, ~0ull) == 1ull << 63 && remS<u64>(1ull << 63, ~0ull) == 0);
static_assert(divS<u32>(7, 0) == 0 && remS<u32>(7, 0) == 0 && divU<u32>(7, 0) == 0 && remU<u32>(7, 0) == 0);
static_assert(shl<u8>(0xFF, 8) == 0 && shl<u64>(1, 64) == 0 && shrU<u32>(~0u, 32) == 0 &&
              shrS<u16>(0x8000, 99) == 0xFFFF);
static_assert(ltS<u8>(0x80, 0) && !ltS<u8>(0, 0x80) && leS<u64>(1ull << 63, 1ull << 63));
static_assert(popCount<u64>(~0ull) == 64 && popCount<u8>(0) == 0);
static_assert(bcdEncode<u8>(99) == 0x99 && bcdEncode<u8>(255) == 0x55 && bcdDecode<u8>(0xFF) == 165);
static_assert(bcdEncode<u64>(9999999999999999ull) == 0x9999999999999999ull && bcdDecode<u16>(0x9999) == 9999);
static_assert(toBits(fadd(1.5, 2.25)) == toBits(3.75));
static_assert(toBits(fdiv(1.0, 0.0)) == 0x7FF0000000000000 && toBits(fdiv(0.0, 0.0)) == kNanBits);
static_assert(fToInt<u8>(-1e9) == 0x80 && fToInt<u8>(1e9) == 0x7F && fToIntNearest(2.5) == 2);
static_assert(intToF<u8>(0xFF) == -1.0);

// ---- integers ------------------------------------------------------------------------------------------------------

TEST(Sem, AllPairsOfBytes) {
  for (int a = 0; a < 256; ++a)
    for (int b = 0; b < 256; ++b) {
      const u8 x = static_cast<u8>(a);
      const u8 y = static_cast<u8>(b);
      const int sx = a < 128 ? a : a - 256;
      const int sy = b < 128 ? b : b - 256;
      ASSERT_EQ(add(x, y), (a + b) % 256);
      ASSERT_EQ(sub(x, y), (a - b + 256) % 256);
      ASSERT_EQ(mul(x, y), a * b % 256);
      ASSERT_EQ(divU(x, y), b == 0 ? 0 : a / b);
      ASSERT_EQ(remU(x, y), b == 0 ? 0 : a % b);
      ASSERT_EQ(divS(x, y), b == 0 ? 0 : (sx / sy + 256) % 256) << sx << " / " << sy;
      ASSERT_EQ(remS(x, y), b == 0 ? 0 : (sx % sy + 256) % 256) << sx << " % " << sy;
      ASSERT_EQ(ltS(x, y), sx < sy);
      ASSERT_EQ(leS(x, y), sx <= sy);
      ASSERT_EQ(shl(x, static_cast<u32>(b)), b >= 8 ? 0 : (a << b) % 256);
      ASSERT_EQ(shrU(x, static_cast<u32>(b)), b >= 8 ? 0 : a >> b);
      ASSERT_EQ(shrS(x, static_cast<u32>(b)),
                b >= 8 ? (sx < 0 ? 255 : 0) : (static_cast<int>(std::floor(sx / std::pow(2.0, b))) + 256) % 256);
    }
}

TEST(Sem, AllWordsOneByOne) {
  for (u32 a = 0; a < 65536; ++a) {
    const u16 x = static_cast<u16>(a);
    ASSERT_EQ(neg(x), (65536 - a) % 65536);
    u32 ones = 0;
    for (u32 bit = 0; bit < 16; ++bit) ones += (a >> bit) & 1;
    ASSERT_EQ(popCount(x), ones);
    ASSERT_EQ(bcdEncode(x), (a / 1000 % 10) * 4096 + (a / 100 % 10) * 256 + (a / 10 % 10) * 16 + a % 10);
    ASSERT_EQ(bcdDecode(x), ((a >> 12) * 1000 + (a >> 8 & 15) * 100 + (a >> 4 & 15) * 10 + (a & 15)) % 65536);
    ASSERT_EQ(asSigned(x), a < 32768 ? static_cast<i64>(a) : static_cast<i64>(a) - 65536);
  }
}

TEST(Sem, WideIntegers) {
  constexpr u64 kMin = 1ull << 63;
  EXPECT_EQ(mul<u64>(kMin, 3), kMin);
  EXPECT_EQ(mul<u32>(0x80000001, 0x80000001), 1u);
  EXPECT_EQ(mul<u16>(0xFFFF, 0xFFFF), 1u); // would overflow an int
  EXPECT_EQ(divS<u64>(kMin, 2), 0xC000000000000000u);
  EXPECT_EQ(divS<u32>(0xFFFFFFF9, 2), 0xFFFFFFFDu); // -7 / 2 = -3
  EXPECT_EQ(remS<u32>(0xFFFFFFF9, 2), 0xFFFFFFFFu); // -7 % 2 = -1
  EXPECT_EQ(divU<u64>(~0ull, 10), 1844674407370955161u);
  EXPECT_EQ(remU<u64>(~0ull, 10), 5u);
  EXPECT_EQ(shl<u64>(1, 63), kMin);
  EXPECT_EQ(shl<u32>(1, 0xFFFFFFFF), 0u);
  EXPECT_EQ(shrS<u64>(kMin, 63), ~0ull);
  EXPECT_EQ(shrS<u64>(kMin, 0xFFFFFFFF), ~0ull);
  EXPECT_EQ(shrS<u32>(0x40000000, 31), 0u);
  EXPECT_EQ(shrU<u64>(kMin, 63), 1u);
  EXPECT_EQ(bcdDecode<u64>(0xFFFFFFFFFFFFFFFF), 15u * 1111111111111111u);
  EXPECT_EQ(bcdEncode<u32>(123456789), 0x23456789u);
}

// ---- floating point ------------------------------------------------------------------------------------------------

constexpr double kInf = std::numeric_limits<double>::infinity();
const double kNan = fromBits(0xFFF8000000000123); // a NaN that no operation gives

TEST(Sem, NanResultsAreOneNan) {
  for (double x :
       {fadd(kNan, 1), fadd(1, kNan), fadd(kInf, -kInf), fsub(kInf, kInf), fsub(kNan, kNan), fmul(kInf, 0),
        fmul(0, -kInf), fmul(kNan, 2), fdiv(0, 0), fdiv(0, -0.0), fdiv(kInf, kInf), fdiv(kNan, 0), fdiv(1, kNan)})
    EXPECT_EQ(toBits(x), kNanBits);
}

TEST(Sem, DivisionByZeroHasTheSignOfBoth) {
  EXPECT_EQ(fdiv(1, 0), kInf);
  EXPECT_EQ(fdiv(-1, 0), -kInf);
  EXPECT_EQ(fdiv(1, -0.0), -kInf);
  EXPECT_EQ(fdiv(-1, -0.0), kInf);
  EXPECT_EQ(fdiv(kInf, 0), kInf);
  EXPECT_EQ(fdiv(-kInf, 0), -kInf);
  EXPECT_EQ(toBits(fdiv(-1, kInf)), 1ull << 63);
}

TEST(Sem, SignsOfFloatsAreBits) {
  EXPECT_EQ(toBits(fneg(0.0)), 1ull << 63);
  EXPECT_EQ(toBits(fneg(kNan)), 0x7FF8000000000123u);
  EXPECT_EQ(toBits(sem::fabsolute(kNan)), 0x7FF8000000000123u);
  EXPECT_EQ(toBits(sem::fabsolute(-0.0)), 0u);
  EXPECT_EQ(sem::fabsolute(-kInf), kInf);
}

TEST(Sem, FloatToIntegerSaturates) {
  struct Row {
    double x;
    u8 as8;
    u32 as32;
    u64 as64;
  };
  constexpr u64 kMin64 = 1ull << 63;
  const Row rows[] = {
      {0.0, 0, 0, 0},
      {-0.0, 0, 0, 0},
      {0.999999, 0, 0, 0},
      {-0.999999, 0, 0, 0},
      {1.5, 1, 1, 1},
      {-1.5, 0xFF, 0xFFFFFFFF, ~0ull},
      {127.999, 127, 127, 127},
      {128, 127, 128, 128},
      {-128, 0x80, 0xFFFFFF80, 0xFFFFFFFFFFFFFF80},
      {-128.999, 0x80, 0xFFFFFF80, 0xFFFFFFFFFFFFFF80},
      {-129, 0x80, 0xFFFFFF7F, 0xFFFFFFFFFFFFFF7F},
      {2147483647.9, 127, 0x7FFFFFFF, 0x7FFFFFFF},
      {2147483648.0, 127, 0x7FFFFFFF, 0x80000000},
      {-2147483648.9, 0x80, 0x80000000, 0xFFFFFFFF80000000},
      {-2147483649.0, 0x80, 0x80000000, 0xFFFFFFFF7FFFFFFF},
      {9223372036854774784.0, 127, 0x7FFFFFFF, 0x7FFFFFFFFFFFFC00},
      {9223372036854775808.0, 127, 0x7FFFFFFF, kMin64 - 1},
      {-9223372036854775808.0, 0x80, 0x80000000, kMin64},
      {-9223372036854777856.0, 0x80, 0x80000000, kMin64},
      {kInf, 127, 0x7FFFFFFF, kMin64 - 1},
      {-kInf, 0x80, 0x80000000, kMin64},
      {kNan, 0, 0, 0},
      {5e-324, 0, 0, 0},
  };
  for (const Row& row : rows) {
    EXPECT_EQ(fToInt<u8>(row.x), row.as8) << row.x;
    EXPECT_EQ(fToInt<u32>(row.x), row.as32) << row.x;
    EXPECT_EQ(fToInt<u64>(row.x), row.as64) << row.x;
  }
  EXPECT_EQ(fToInt<u16>(32767.5), 0x7FFF);
  EXPECT_EQ(fToInt<u16>(-32768.5), 0x8000);
  EXPECT_EQ(fToInt<u16>(40000), 0x7FFF);
}

TEST(Sem, FloatToNearestTiesToEven) {
  constexpr u64 kMin = 1ull << 63;
  const std::pair<double, i64> rows[] = {{0.0, 0},
                                         {-0.0, 0},
                                         {0.5, 0},
                                         {1.5, 2},
                                         {2.5, 2},
                                         {3.5, 4},
                                         {-0.5, 0},
                                         {-1.5, -2},
                                         {-2.5, -2},
                                         {-3.5, -4},
                                         {0.49999999999999994, 0},
                                         {0.50000000000000011, 1},
                                         {-0.49999999999999994, 0},
                                         {-0.50000000000000011, -1},
                                         {1.4999999999999998, 1},
                                         {2.4999999999999996, 2},
                                         {2.5000000000000004, 3},
                                         {1e15 + 0.5, 1000000000000000},
                                         {4503599627370495.5, 4503599627370496},
                                         {-4503599627370495.5, -4503599627370496},
                                         {4503599627370497.0, 4503599627370497},
                                         {9223372036854774784.0, 9223372036854774784},
                                         {-9223372036854775808.0, std::numeric_limits<i64>::min()}};
  for (const auto& [x, nearest] : rows) EXPECT_EQ(static_cast<i64>(fToIntNearest(x)), nearest) << x;
  for (double x : {9223372036854775808.0, -9223372036854777856.0, 1e300, kInf, -kInf, kNan})
    EXPECT_EQ(fToIntNearest(x), kMin) << x;
  // Everywhere else as the machine rounds.
  for (double x = -1000; x < 1000; x += 0.0625) ASSERT_EQ(static_cast<i64>(fToIntNearest(x)), std::llrint(x)) << x;
}

TEST(Sem, IntegerToFloat) {
  EXPECT_EQ(intToF<u8>(0x80), -128.0);
  EXPECT_EQ(intToF<u32>(0xFFFFFFFF), -1.0);
  EXPECT_EQ(intToF<u64>(1ull << 63), -9223372036854775808.0);
  EXPECT_EQ(intToF<u64>((1ull << 53) + 1), 9007199254740992.0); // nearest, ties to even
  EXPECT_EQ(intToF<u64>((1ull << 53) + 3), 9007199254740996.0);
}

} // namespace
} // namespace rung::sem
