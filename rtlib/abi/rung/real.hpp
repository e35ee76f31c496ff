// Elementary functions of doubles: square root, power, sine and the rest. They are computed in integers, with 110 bits
// and more, and rounded once: they do not depend on library, optimiser or machine, and all but one in 2^50 results are
// the double nearest to the exact value. Part of sem.hpp, the only file that includes it.
//
// Values here are fixed-point numbers of 128 bits ("Q1.127": one bit before the point) and Wide, a floating-point
// number with 128 bits. Helpers that are used in many places are not inlined: a program contains one copy of each.
#ifndef RUNG_REAL_HPP
#define RUNG_REAL_HPP

#include "rung/sem.hpp"

#define RUNG_SHARED __attribute__((noinline)) constexpr

namespace rung::sem {
namespace wide {

// ---- 128 bits ----------------------------------------------------------------------------------------------------
struct U128 {
  u64 hi;
  u64 lo;
};

constexpr U128 add(U128 a, U128 b) noexcept {
  const u64 lo = a.lo + b.lo;
  return {a.hi + b.hi + (lo < a.lo ? 1u : 0u), lo};
}
constexpr U128 sub(U128 a, U128 b) noexcept { return {a.hi - b.hi - (a.lo < b.lo ? 1u : 0u), a.lo - b.lo}; }
constexpr bool less(U128 a, U128 b) noexcept { return a.hi != b.hi ? a.hi < b.hi : a.lo < b.lo; }
constexpr bool isZero(U128 a) noexcept { return (a.hi | a.lo) == 0; }
constexpr U128 shiftLeft(U128 a, u32 n) noexcept {
  if (n == 0) return a;
  if (n >= 128) return {0, 0};
  if (n >= 64) return {a.lo << (n - 64), 0};
  return {(a.hi << n) | (a.lo >> (64 - n)), a.lo << n};
}
constexpr U128 shiftRight(U128 a, u32 n) noexcept {
  if (n == 0) return a;
  if (n >= 128) return {0, 0};
  if (n >= 64) return {0, a.hi >> (n - 64)};
  return {a.hi >> n, (a.lo >> n) | (a.hi << (64 - n))};
}
constexpr u32 leadingZeros(u64 a) noexcept {
  u32 n = 0;
  for (u32 step = 32; step != 0; step /= 2)
    if ((a >> (64 - step)) == 0) {
      n += step;
      a <<= step;
    }
  return n + (a == 0 ? 1u : 0u);
}
constexpr u32 leadingZeros(U128 a) noexcept { return a.hi != 0 ? leadingZeros(a.hi) : 64 + leadingZeros(a.lo); }

constexpr U128 mulByHalves(u64 a, u64 b) noexcept {
  constexpr u64 kLow = 0xFFFFFFFF;
  const u64 low = (a & kLow) * (b & kLow);
  const u64 middle = (a >> 32) * (b & kLow) + (low >> 32);
  const u64 other = (a & kLow) * (b >> 32) + (middle & kLow);
  return {(a >> 32) * (b >> 32) + (middle >> 32) + (other >> 32), (other << 32) | (low & kLow)};
}
constexpr U128 mulFull(u64 a, u64 b) noexcept {
#ifdef __SIZEOF_INT128__ // one instruction
  __extension__ using Product = unsigned __int128;
  const Product product = static_cast<Product>(a) * b;
  return {static_cast<u64>(product >> 64), static_cast<u64>(product)};
#else
  return mulByHalves(a, b);
#endif
}
// The upper half of the product, at most 3 too low, which is the product of two fixed-point numbers.
RUNG_SHARED U128 mul(U128 a, U128 b) noexcept {
  const U128 top = mulFull(a.hi, b.hi);
  const u64 x = mulFull(a.hi, b.lo).hi;
  const u64 y = mulFull(a.lo, b.hi).hi;
  return add(add(top, {0, x}), {0, y});
}

// ---- series --------------------------------------------------------------------------------------------------------
constexpr U128 kOne = {1ull << 63, 0}; // Q1.127

constexpr U128 divSmall(U128 a, u32 n) noexcept {
  U128 quotient = {0, 0};
  u64 rest = 0;
  for (u32 i = 0; i < 4; ++i) {
    const u64 limb = (rest << 32) | ((i < 2 ? a.hi : a.lo) >> (i % 2 == 0 ? 32 : 0) & 0xFFFFFFFF);
    quotient = add(shiftLeft(quotient, 32), {0, limb / n});
    rest = limb % n;
  }
  return quotient;
}
constexpr u32 kTerms = 32;
struct Coefficients {
  U128 at[kTerms];
};
constexpr Coefficients inverseFactorials() noexcept {
  Coefficients c{};
  c.at[0] = kOne;
  for (u32 n = 1; n < kTerms; ++n) c.at[n] = divSmall(c.at[n - 1], n);
  return c;
}
constexpr Coefficients inverseWeights() noexcept {
  Coefficients c{};
  for (u32 n = 0; n < kTerms; ++n) c.at[n] = divSmall(kOne, 2 * n + 1);
  return c;
}
inline constexpr Coefficients kInverseFactorial = inverseFactorials(); // 1 / n!
inline constexpr Coefficients kInverseOdd = inverseWeights();          // 1 / (2 n + 1)

// The sum of c[first + step * k] * z^k, k = 0 to terms, with alternating signs or without; z is Q0.128, below 1. There
// are fewer terms than kTerms; the loop states this bound for analyses of the longest path.
RUNG_SHARED U128 series(const Coefficients& c, u32 first, u32 step, u32 terms, bool alternating, U128 z) noexcept {
  U128 sum = c.at[first + step * terms];
  for (u32 k = terms % kTerms; k-- != 0;) {
    const U128 next = mul(sum, z);
    sum = alternating ? sub(c.at[first + step * k], next) : add(c.at[first + step * k], next);
  }
  return sum;
}

// ---- numbers -------------------------------------------------------------------------------------------------------
// m * 2^(e - 127) with the top bit of m set, or 0.
struct Wide {
  U128 m;
  i32 e;
  bool negative;
};

constexpr Wide normalised(U128 m, i32 e, bool negative) noexcept {
  if (isZero(m)) return {m, 0, false};
  const u32 n = leadingZeros(m);
  return {shiftLeft(m, n), e - static_cast<i32>(n), negative};
}
constexpr Wide fromInt(i64 a) noexcept {
  return normalised({a < 0 ? 0 - static_cast<u64>(a) : static_cast<u64>(a), 0}, 63, a < 0);
}
// x must be finite.
RUNG_SHARED Wide fromDouble(double x) noexcept {
  const u64 bits = toBits(x);
  const i32 exponent = static_cast<i32>(bits >> 52 & 0x7FF);
  const u64 fraction = bits & ((1ull << 52) - 1);
  const u64 m = exponent == 0 ? fraction : fraction | (1ull << 52);
  return normalised({m << 11, 0}, (exponent == 0 ? 1 : exponent) - 1023, bits >> 63 != 0);
}

RUNG_SHARED Wide mul(const Wide& a, const Wide& b) noexcept {
  return normalised(mul(a.m, b.m), a.e + b.e + 1, a.negative != b.negative);
}
RUNG_SHARED Wide add(const Wide& a, const Wide& b) noexcept {
  if (isZero(a.m)) return b;
  if (isZero(b.m)) return a;
  const bool swap = a.e != b.e ? a.e < b.e : less(a.m, b.m);
  const Wide& big = swap ? b : a;
  const Wide& small = swap ? a : b;
  const u32 distance = static_cast<u32>(big.e - small.e);
  if (a.negative != b.negative) return normalised(sub(big.m, shiftRight(small.m, distance)), big.e, big.negative);
  return normalised(add(shiftRight(big.m, 1), shiftRight(shiftRight(small.m, distance), 1)), big.e + 1, big.negative);
}
constexpr Wide negate(const Wide& a) noexcept { return {a.m, a.e, !a.negative}; }

// By Newton's method from 31 bits; b is not 0. Fixed-point numbers are Q2.126 here.
RUNG_SHARED Wide divide(const Wide& a, const Wide& b) noexcept {
  U128 y = shiftRight({~0ull / (b.m.hi >> 32) << 31, 0}, 1); // about 1 / b for b in [1/2, 1)
  for (int i = 0; i < 3; ++i) y = shiftLeft(mul(y, sub({1ull << 63, 0}, mul(b.m, y))), 2);
  return normalised(mul(a.m, y), a.e - b.e + 1, a.negative != b.negative);
}

// a must not be negative. Newton's method for 1 / sqrt, from the root of the upper 64 bits.
RUNG_SHARED Wide squareRoot(const Wide& a) noexcept {
  if (isZero(a.m)) return a;
  const bool odd = (a.e & 1) != 0;
  const U128 f = odd ? a.m : shiftRight(a.m, 1); // in [1/4, 1): a = f * 2^(even number)
  u64 root = 0;
  u64 rest = f.hi;
  for (u64 bit = 1ull << 62; bit != 0; bit >>= 2) {
    const bool fits = rest >= root + bit;
    if (fits) rest -= root + bit;
    root = (root >> 1) + (fits ? bit : 0);
  }
  U128 r = shiftRight({~0ull / root << 31, 0}, 1); // Q2.126, in [1, 2]
  for (int i = 0; i < 3; ++i) {
    const U128 t = mul(f, mul(r, r)); // Q4.124, about 1
    r = shiftLeft(mul(r, sub({3ull << 60, 0}, t)), 3);
  }
  return normalised(mul(f, r), (odd ? a.e + 1 : a.e + 2) / 2 + 1, false);
}

// Rounds to the nearest double, ties to even. `exact`: the exact value may be a double or halfway between two; a value
// closer to halfway than the error of the computation is treated as halfway.
RUNG_SHARED double toDouble(const Wide& a, bool exact = false) noexcept {
  const u64 sign = a.negative ? 1ull << 63 : 0;
  if (isZero(a.m) || a.e < -1075) return fromBits(sign);
  if (a.e > 1023) return fromBits(sign | 0x7FFull << 52);
  const bool normal = a.e >= -1022;
  const u32 drop = 75u + (normal ? 0u : static_cast<u32>(-1022 - a.e));
  u64 kept = shiftRight(a.m, drop).lo;
  const U128 rest = sub(a.m, shiftLeft({0, kept}, drop));
  const U128 half = shiftLeft({0, 1}, drop - 1);
  const bool above = less(half, rest);
  const U128 distance = above ? sub(rest, half) : sub(half, rest);
  const bool tie = exact ? less(distance, {0, 1ull << 16}) : isZero(distance);
  if (tie ? (kept & 1) != 0 : above) ++kept;
  // A carry out of the fraction moves the exponent.
  return fromBits(sign | ((normal ? static_cast<u64>(a.e + 1022) << 52 : 0) + kept));
}

inline constexpr Wide kHalfPi = {{0xC90FDAA22168C234ull, 0xC4C6628B80DC1CD1ull}, 0, false};
inline constexpr Wide kPi = {kHalfPi.m, 1, false};
inline constexpr Wide kLn2 = {{0xB17217F7D1CF79ABull, 0xC9E3B39803F2F6AFull}, -1, false};
inline constexpr U128 kLog2E = {0xB8AA3B295C17F0BBull, 0xBE87FED0691D3E88ull}; // Q1.127

// value^2 as Q0.128; |value| < 1.
constexpr U128 squareOf(const Wide& a) noexcept {
  return isZero(a.m) ? U128{0, 0} : shiftRight(mul(a.m, a.m), static_cast<u32>(-2 * a.e - 2));
}

// ---- exponential and logarithm -------------------------------------------------------------------------------------
RUNG_SHARED Wide exponential(const Wide& x) noexcept {
  if (isZero(x.m)) return {kOne, 0, false};
  if (x.e > 10) return {kOne, x.negative ? -5000 : 5000, false};
  const U128 fixed = shiftRight(x.m, static_cast<u32>(11 - x.e)); // Q12.116
  const U128 ln2 = kLn2.m;                                        // Q0.128
  i32 k = static_cast<i32>(mul(fixed, kLog2E).hi >> 51);          // |x| / ln 2
  U128 r = shiftLeft(sub(fixed, mul({static_cast<u64>(k) << 52, 0}, ln2)), 12);
  if (!less(r, ln2)) {
    r = sub(r, ln2);
    ++k;
  }
  if (x.negative) {
    k = -k;
    if (!isZero(r)) {
      r = sub(ln2, r);
      --k;
    }
  }
  return normalised(series(kInverseFactorial, 0, 1, 30, false, r), k, false);
}

// x must be positive.
RUNG_SHARED Wide logarithm(const Wide& x) noexcept {
  constexpr u64 kRoot2 = 0xB504F333F9DE6484ull;
  const bool low = x.m.hi < kRoot2;
  const i32 power = low ? x.e : x.e + 1;
  const Wide m = {x.m, low ? 0 : -1, false};
  const Wide one = {kOne, 0, false};
  const Wide s = divide(add(m, negate(one)), add(m, one));
  const U128 sum = series(kInverseOdd, 0, 1, 24, false, squareOf(s)); // artanh s = s * sum
  Wide fraction = mul(s, {sum, 0, false});
  fraction.e += 1;
  return add(mul(fromInt(power), kLn2), isZero(s.m) ? Wide{} : fraction);
}

// ---- angles --------------------------------------------------------------------------------------------------------
// The bits of 2 / pi, starting 64 bits before the point.
struct TwoOverPi {
  u64 at[21];
};
inline constexpr TwoOverPi kTwoOverPi = {
    {0x0000000000000000ull, 0xA2F9836E4E441529ull, 0xFC2757D1F534DDC0ull, 0xDB6295993C439041ull, 0xFE5163ABDEBBC561ull,
     0xB7246E3A424DD2E0ull, 0x06492EEA09D1921Cull, 0xFE1DEB1CB129A73Eull, 0xE88235F52EBB4484ull, 0xE99C7026B45F7E41ull,
     0x3991D639835339F4ull, 0x9C845F8BBDF9283Bull, 0x1FF897FFDE05980Full, 0xEF2F118B5A0A6D1Full, 0x6D367ECF27CB09B7ull,
     0x4F463F669E5FEA2Dull, 0x7527BAC7EBE5F17Bull, 0x3D0739F78A5292EAull, 0x6BFB5FB11F8D5D08ull, 0x56033046FC7B6BABull,
     0xF0CFBC209AF4361Dull}};

// angle = quadrant * pi/2 + rest, quadrant modulo 4, |rest| <= pi/4.
struct Reduced {
  Wide rest;
  u32 quadrant;
};

// The angle times 2 / pi, computed with the 256 bits of 2 / pi that contribute neither whole turns nor less than the
// precision of the result (Payne and Hanek).
RUNG_SHARED Reduced reduced(const Wide& x) noexcept {
  if (x.e < -1 || (x.e == -1 && x.m.hi < kHalfPi.m.hi)) return {x, 0};
  const u64 m = x.m.hi >> 11;                   // |x| = m * 2^(e - 52)
  const u32 first = static_cast<u32>(x.e + 10); // first bit used, as an index into the table
  const u32 word = first / 64;
  const u32 shift = first % 64;
  u64 y[4] = {}; // |x| * 2 / pi modulo 4, Q2.254, the highest word first
  u64 carry = 0;
  for (u32 i = 4; i-- != 0;) {
    const u64 high = kTwoOverPi.at[word + i] << shift;
    const u64 bits = shift == 0 ? high : high | kTwoOverPi.at[word + i + 1] >> (64 - shift);
    const U128 product = add(mulFull(bits, m), {0, carry});
    y[i] = product.lo;
    carry = product.hi;
  }
  u32 quadrant = static_cast<u32>(y[0] >> 62);
  for (u32 i = 0; i < 4; ++i) y[i] = y[i] << 2 | (i < 3 ? y[i + 1] >> 62 : 0);
  const bool up = y[0] >> 63 != 0;
  if (up) {
    ++quadrant;
    for (u32 i = 0; i < 4; ++i) y[i] = ~y[i];
  }
  const u32 zeros = leadingZeros(y[0] != 0 ? y[0] : 1);
  const U128 top = shiftLeft({y[0], y[1]}, zeros);
  const U128 fraction = zeros == 0 ? top : add(top, {0, y[2] >> (64 - zeros)});
  const Wide rest = mul(normalised(fraction, -1 - static_cast<i32>(zeros), up), kHalfPi);
  if (!x.negative) return {rest, quadrant & 3};
  return {negate(rest), (0 - quadrant) & 3};
}

RUNG_SHARED Wide sineOf(const Wide& rest) noexcept {
  if (isZero(rest.m)) return rest;
  return mul(rest, normalised(series(kInverseFactorial, 1, 2, 15, true, squareOf(rest)), 0, false));
}
RUNG_SHARED Wide cosineOf(const Wide& rest) noexcept {
  return normalised(series(kInverseFactorial, 0, 2, 15, true, squareOf(rest)), 0, false);
}
constexpr Wide sine(const Reduced& a) noexcept {
  const Wide s = (a.quadrant & 1) != 0 ? cosineOf(a.rest) : sineOf(a.rest);
  return (a.quadrant & 2) != 0 ? negate(s) : s;
}

// arctan(k / 8)
struct ArcTangents {
  Wide at[9];
};
inline constexpr ArcTangents kArcTangent = {{{},
                                             {{0xFEADD4D5617B6E32ull, 0xC897989F3E888EF7ull}, -4, false},
                                             {{0xFADBAFC96406EB15ull, 0x6DC79EF5F7A217E5ull}, -3, false},
                                             {{0xB7B0CA0F26F78473ull, 0x8AA32122DCFE4483ull}, -2, false},
                                             {{0xED63382B0DDA7B45ull, 0x6FE445ECBC3A8D03ull}, -2, false},
                                             {{0x8F005D5EF7F59F9Bull, 0x5C835E1665C43747ull}, -1, false},
                                             {{0xA4BC7D1934F70924ull, 0x19A87F2A457DAC9Eull}, -1, false},
                                             {{0xB8053E2BC2319E73ull, 0xCB2DA55210A4443Dull}, -1, false},
                                             {{0xC90FDAA22168C234ull, 0xC4C6628B80DC1CD1ull}, -1, false}}};

// The angle of (d, n) for n, d >= 0, not both 0.
RUNG_SHARED Wide arcTangent(const Wide& n, const Wide& d) noexcept {
  if (isZero(n.m)) return n;
  if (isZero(d.m)) return kHalfPi;
  const bool steep = n.e != d.e ? n.e > d.e : less(d.m, n.m);
  const Wide& small = steep ? d : n;
  const Wide& big = steep ? n : d;
  const u32 distance = static_cast<u32>(big.e - small.e);
  const u64 part = distance > 63 ? 0 : small.m.hi >> distance >> 5;
  const u64 k = (16 * part + (big.m.hi >> 5)) / (big.m.hi >> 4); // small / big in eighths
  Wide eighths = fromInt(static_cast<i64>(k));
  eighths.e -= 3;
  const Wide u = divide(add(small, negate(mul(eighths, big))), add(big, mul(eighths, small)));
  const Wide sum = normalised(series(kInverseOdd, 0, 1, 16, true, squareOf(u)), 0, false);
  const Wide angle = add(kArcTangent.at[k], mul(u, sum));
  return steep ? add(kHalfPi, negate(angle)) : angle;
}

// sqrt(1 - x^2)
constexpr Wide cathetus(const Wide& x) noexcept {
  const Wide one = {kOne, 0, false};
  return squareRoot(mul(add(one, x), add(one, negate(x))));
}
constexpr Wide magnitude(const Wide& x) noexcept { return {x.m, x.e, false}; }

} // namespace wide

constexpr bool isInfinite(double x) noexcept { return toBits(x) << 1 == 0x7FFull << 53; }
constexpr bool isFinite(double x) noexcept { return (toBits(x) >> 52 & 0x7FF) != 0x7FF; }

// The root of -0 is -0, that of a negative number NaN. The machine's own root is correctly rounded (IEEE 754), so it is
// used; constant evaluation computes it here.
constexpr double fsqrt(double x) noexcept {
  if (x == 0) return x;
  if (!(x > 0)) return fromBits(kNanBits);
  if (isInfinite(x)) return x;
  if (!__builtin_is_constant_evaluated()) return __builtin_sqrt(x);
  return wide::toDouble(wide::squareRoot(wide::fromDouble(x)));
}

// The rules of IEEE 754 for pow: any base to the power of 0 is 1, 1 to any power is 1; a negative base has only powers
// with whole exponents; +-0 and infinities follow their limits.
RUNG_SHARED double fpow(double x, double y) noexcept {
  constexpr u64 kInfinity = 0x7FFull << 52;
  if (y == 0 || x == 1) return 1;
  if (x != x || y != y) return fromBits(kNanBits);
  const u64 size = toBits(y) & ~(1ull << 63);
  // From 2^53 on every double is even.
  const bool whole = size >= toBits(9007199254740992.0) || static_cast<double>(static_cast<i64>(y)) == y;
  const bool odd = whole && size < toBits(9007199254740992.0) && (static_cast<i64>(y) & 1) != 0;
  const u64 sign = odd ? toBits(x) & (1ull << 63) : 0;
  const bool grows = y > 0;
  if (isInfinite(y)) {
    if (x == -1) return 1;
    return fromBits((fabsolute(x) > 1) == grows ? kInfinity : 0);
  }
  if (x == 0 || isInfinite(x)) return fromBits(sign | ((x == 0) == grows ? 0 : kInfinity));
  if (x < 0 && !whole) return fromBits(kNanBits);
  wide::Wide result =
      wide::exponential(wide::mul(wide::fromDouble(y), wide::logarithm(wide::magnitude(wide::fromDouble(x)))));
  result.negative = sign != 0;
  return wide::toDouble(result, true);
}

// Angles are in radians; an infinite angle gives NaN.
RUNG_SHARED double fsin(double x) noexcept {
  if (x == 0) return x;
  if (!isFinite(x)) return fromBits(kNanBits);
  return wide::toDouble(wide::sine(wide::reduced(wide::fromDouble(x))));
}
RUNG_SHARED double fcos(double x) noexcept {
  if (!isFinite(x)) return fromBits(kNanBits);
  wide::Reduced a = wide::reduced(wide::fromDouble(x));
  a.quadrant = (a.quadrant + 1) & 3;
  return wide::toDouble(wide::sine(a));
}
// NaN if an odd multiple of pi/2 is within the distance of two neighbouring doubles, so always from 2^53 on.
RUNG_SHARED double ftan(double x) noexcept {
  if (x == 0) return x;
  if (!isFinite(x) || fabsolute(x) >= 9007199254740992.0) return fromBits(kNanBits);
  const wide::Wide angle = wide::fromDouble(x);
  const wide::Reduced a = wide::reduced(angle);
  const wide::Wide s = wide::sineOf(a.rest);
  const wide::Wide c = wide::cosineOf(a.rest);
  const bool odd = (a.quadrant & 1) != 0;
  const wide::Wide toPole = odd ? a.rest : wide::add(wide::kHalfPi, {a.rest.m, a.rest.e, true});
  if (toPole.e < angle.e - 52) return fromBits(kNanBits);
  return wide::toDouble(odd ? wide::negate(wide::divide(c, s)) : wide::divide(s, c));
}

// Outside -1 to 1: NaN.
RUNG_SHARED double fasin(double x) noexcept {
  if (x == 0) return x;
  if (!(fabsolute(x) <= 1)) return fromBits(kNanBits);
  const wide::Wide n = wide::fromDouble(x);
  wide::Wide angle = wide::arcTangent(wide::magnitude(n), wide::cathetus(n));
  angle.negative = n.negative;
  return wide::toDouble(angle);
}
RUNG_SHARED double facos(double x) noexcept {
  if (!(fabsolute(x) <= 1)) return fromBits(kNanBits);
  const wide::Wide d = wide::fromDouble(x);
  const wide::Wide angle = wide::arcTangent(wide::cathetus(d), wide::magnitude(d));
  return wide::toDouble(d.negative ? wide::add(wide::kPi, wide::negate(angle)) : angle);
}
RUNG_SHARED double fatan(double x) noexcept {
  if (x == 0) return x;
  if (x != x) return fromBits(kNanBits);
  wide::Wide angle =
      isInfinite(x) ? wide::kHalfPi : wide::arcTangent(wide::magnitude(wide::fromDouble(x)), {wide::kOne, 0, false});
  angle.negative = x < 0;
  return wide::toDouble(angle);
}

RUNG_SHARED double fexp(double x) noexcept {
  if (x != x) return fromBits(kNanBits);
  if (isInfinite(x)) return x > 0 ? x : 0;
  return wide::toDouble(wide::exponential(wide::fromDouble(x)));
}
// For 0 -infinity, for a negative number NaN.
RUNG_SHARED double flog(double x) noexcept {
  if (x == 0) return fromBits(0xFFFull << 52);
  if (!(x > 0)) return fromBits(kNanBits);
  if (isInfinite(x)) return x;
  return wide::toDouble(wide::logarithm(wide::fromDouble(x)));
}

} // namespace rung::sem

#undef RUNG_SHARED
#endif
