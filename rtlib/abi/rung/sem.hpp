// The arithmetic of the IR: the only definition of every operation that machines do not define alike. The constant
// folder, the interpreter and generated C++ call these functions; the LLVM back end links them as bitcode. All are
// total: every input has a defined result. Freestanding: the only header is <stdint.h>. Elementary functions such as
// sine are in real.hpp.
#ifndef RUNG_SEM_HPP
#define RUNG_SEM_HPP

#include <stdint.h>

namespace rung::sem {

using u8 = uint8_t;
using u16 = uint16_t;
using u32 = uint32_t;
using u64 = uint64_t;
using i8 = int8_t;
using i16 = int16_t;
using i32 = int32_t;
using i64 = int64_t;

// The signed type of the same width. Values are passed as unsigned integers; the operation determines the sign.
template <class U>
struct SignedOf;
template <>
struct SignedOf<u8> {
  using type = i8;
};
template <>
struct SignedOf<u16> {
  using type = i16;
};
template <>
struct SignedOf<u32> {
  using type = i32;
};
template <>
struct SignedOf<u64> {
  using type = i64;
};

template <class U>
constexpr i64 asSigned(U x) noexcept {
  return static_cast<typename SignedOf<U>::type>(x);
}
template <class U>
constexpr u32 bitsOf() noexcept {
  return sizeof(U) * 8;
}

// ---- bits, which are bool, and integers ---------------------------------------------------------------------------
// Bits are combined by & and |, too: && and || would require jumps, which compilers would keep as conditional moves.
template <class U>
constexpr U bitAnd(U a, U b) noexcept {
  return static_cast<U>(a & b);
}
template <class U>
constexpr U bitOr(U a, U b) noexcept {
  return static_cast<U>(a | b);
}
template <class U>
constexpr U bitXor(U a, U b) noexcept {
  return static_cast<U>(a ^ b);
}
template <class U>
constexpr U bitNot(U a) noexcept {
  return static_cast<U>(~a);
}
constexpr bool bitNot(bool a) noexcept { return !a; }
template <class U>
constexpr bool eq(U a, U b) noexcept {
  return a == b;
}
template <class U>
constexpr bool ne(U a, U b) noexcept {
  return a != b;
}
template <class U>
constexpr U choose(bool which, U a, U b) noexcept {
  return which ? a : b;
}

// Conversions to another width.
template <class To, class From>
constexpr To widen(From a) noexcept {
  return static_cast<To>(a);
}
template <class To, class From>
constexpr To widenSigned(From a) noexcept {
  return static_cast<To>(asSigned(a));
}
template <class To>
constexpr To widenSigned(bool a) noexcept {
  return static_cast<To>(0 - static_cast<u64>(a));
}
// Conversion to a bit takes the lowest bit, whereas a cast to bool tests all bits.
template <class To>
inline constexpr bool kIsBit = false;
template <>
inline constexpr bool kIsBit<bool> = true;
template <class To, class From>
constexpr To narrow(From a) noexcept {
  if constexpr (kIsBit<To>)
    return (a & 1) != 0;
  else
    return static_cast<To>(a);
}

// ---- integers: wrap around
// --------------------------------------------------------------------------------------
template <class U>
constexpr U add(U a, U b) noexcept {
  return static_cast<U>(static_cast<u64>(a) + b);
}
template <class U>
constexpr U sub(U a, U b) noexcept {
  return static_cast<U>(static_cast<u64>(a) - b);
}
template <class U>
constexpr U mul(U a, U b) noexcept {
  return static_cast<U>(static_cast<u64>(a) * b);
}
template <class U>
constexpr U neg(U a) noexcept {
  return static_cast<U>(0 - static_cast<u64>(a));
}

// Division toward zero. By zero: quotient 0, remainder 0. MIN / -1: MIN, remainder 0.
template <class U>
constexpr U divU(U a, U b) noexcept {
  return b == 0 ? U(0) : static_cast<U>(a / b);
}
template <class U>
constexpr U remU(U a, U b) noexcept {
  return b == 0 ? U(0) : static_cast<U>(a % b);
}
template <class U>
constexpr U divS(U a, U b) noexcept {
  if (b == 0) return 0;
  if (b == static_cast<U>(~static_cast<U>(0))) return neg(a);
  return static_cast<U>(asSigned(a) / asSigned(b));
}
template <class U>
constexpr U remS(U a, U b) noexcept {
  if (b == 0 || b == static_cast<U>(~static_cast<U>(0))) return 0;
  return static_cast<U>(asSigned(a) % asSigned(b));
}

// Shifts by an unsigned 32-bit count; a count of the width or more shifts everything out.
template <class U>
constexpr U shl(U a, u32 n) noexcept {
  return n >= bitsOf<U>() ? U(0) : static_cast<U>(static_cast<u64>(a) << n);
}
template <class U>
constexpr U shrU(U a, u32 n) noexcept {
  return n >= bitsOf<U>() ? U(0) : static_cast<U>(a >> n);
}
template <class U>
constexpr U shrS(U a, u32 n) noexcept {
  return static_cast<U>(asSigned(a) >> (n >= bitsOf<U>() ? bitsOf<U>() - 1 : n));
}

template <class U>
constexpr bool ltS(U a, U b) noexcept {
  return asSigned(a) < asSigned(b);
}
template <class U>
constexpr bool leS(U a, U b) noexcept {
  return asSigned(a) <= asSigned(b);
}
template <class U>
constexpr bool ltU(U a, U b) noexcept {
  return a < b;
}
template <class U>
constexpr bool leU(U a, U b) noexcept {
  return a <= b;
}

template <class U>
constexpr U popCount(U a) noexcept {
  U n = 0;
  for (; a != 0; a = static_cast<U>(a & (a - 1))) n = static_cast<U>(n + 1);
  return n;
}

// Packed BCD, one digit per nibble. Encoding drops digits above the width; decoding uses a nibble above 9 with its
// value.
template <class U>
constexpr U bcdEncode(U a) noexcept {
  U r = 0;
  for (u32 n = 0; n < bitsOf<U>(); n += 4, a = static_cast<U>(a / 10))
    r = static_cast<U>(r | (static_cast<u64>(a % 10) << n));
  return r;
}
template <class U>
constexpr U bcdDecode(U a) noexcept {
  U r = 0;
  for (u32 n = bitsOf<U>(); n != 0; n -= 4) r = static_cast<U>(static_cast<u64>(r) * 10 + ((a >> (n - 4)) & 15));
  return r;
}

// ---- floating point: IEEE 754 double, nearest even, and one NaN ---------------------------------------------------
// Every NaN result has these bits, so that engines and targets agree to the bit.
constexpr u64 kNanBits = 0x7FF8000000000000ull;

constexpr u64 toBits(double x) noexcept { return __builtin_bit_cast(u64, x); }
constexpr double fromBits(u64 x) noexcept { return __builtin_bit_cast(double, x); }
constexpr double canon(double x) noexcept { return x != x ? fromBits(kNanBits) : x; }

constexpr double fadd(double a, double b) noexcept { return canon(a + b); }
constexpr double fsub(double a, double b) noexcept { return canon(a - b); }
constexpr double fmul(double a, double b) noexcept { return canon(a * b); }
constexpr double fdiv(double a, double b) noexcept {
  if (b == 0) { // written out: a constant evaluation may not divide by zero
    if (a == 0 || a != a) return fromBits(kNanBits);
    return fromBits((0x7FFull << 52) | ((toBits(a) ^ toBits(b)) & (1ull << 63)));
  }
  return canon(a / b);
}
constexpr bool feq(double a, double b) noexcept { return a == b; }
constexpr bool flt(double a, double b) noexcept { return a < b; }
constexpr bool fle(double a, double b) noexcept { return a <= b; }
constexpr double fneg(double a) noexcept { return fromBits(toBits(a) ^ (1ull << 63)); }
constexpr double fabsolute(double a) noexcept { return fromBits(toBits(a) & ~(1ull << 63)); }

// Conversion toward zero, saturating; NaN gives 0.
template <class U>
constexpr U fToInt(double x) noexcept {
  constexpr double kLimit = static_cast<double>(1ull << (bitsOf<U>() - 1)); // 2^(w-1), exact
  constexpr U kMin = static_cast<U>(static_cast<u64>(1) << (bitsOf<U>() - 1));
  if (x != x) return 0;
  if (x >= kLimit) return static_cast<U>(kMin - 1);
  if (x < -kLimit) return kMin;
  return static_cast<U>(static_cast<i64>(x));
}
// Conversion to nearest, ties to even; NaN and values out of range give the smallest number (the x87 rule).
constexpr u64 fToIntNearest(double x) noexcept {
  constexpr double kTwo52 = 4503599627370496.0;
  constexpr double kTwo63 = 9223372036854775808.0;
  if (!(x >= -kTwo63 && x < kTwo63)) return 1ull << 63;
  if (x >= kTwo52 || x <= -kTwo52) return static_cast<u64>(static_cast<i64>(x));
  const i64 low = static_cast<i64>(x) - (x < static_cast<double>(static_cast<i64>(x)) ? 1 : 0); // floor
  const double rest = x - static_cast<double>(low);
  const bool up = rest > 0.5 || (rest == 0.5 && (low & 1) != 0);
  return static_cast<u64>(low + (up ? 1 : 0));
}
template <class U>
constexpr double intToF(U a) noexcept {
  return static_cast<double>(asSigned(a));
}

} // namespace rung::sem

#include "rung/real.hpp"

#endif
