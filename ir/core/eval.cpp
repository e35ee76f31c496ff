// The evaluator of operations without effects (see eval.h).
#include "ir/core/eval.h"

#include "ir/core/ops.h"
#include "ir/support/check.h"
#include "rung/sem.hpp"

namespace rung::ir {
namespace {

// Calls f with a zero of the unsigned integer type that holds a `type`.
template <class F>
uint64_t asInt(Type type, F f) {
  switch (type) {
  case Type::I8: return static_cast<uint64_t>(f(sem::u8{}));
  case Type::I16: return static_cast<uint64_t>(f(sem::u16{}));
  case Type::I32: return static_cast<uint64_t>(f(sem::u32{}));
  case Type::I64: return static_cast<uint64_t>(f(sem::u64{}));
  case Type::None:
  case Type::Bit:
  case Type::F64: break;
  }
  RUNG_CHECK(false, "an integer operation of another type");
  return 0;
}

// The value of `type` as a signed number; a bit 1 is -1.
int64_t signedValue(Type type, uint64_t value) {
  if (type == Type::Bit) return value != 0 ? -1 : 0;
  return static_cast<int64_t>(asInt(type, [&](auto u) { return sem::asSigned(static_cast<decltype(u)>(value)); }));
}

} // namespace

// NOLINTNEXTLINE(readability-function-size): a case for every operation
uint64_t evalPure(OpCode code, Type type, Type first, const uint64_t* args) {
  const uint64_t a = args[0];
  const auto b = [&] { return args[1]; };
  // An integer function of one operand, of two, and of an operand and a count.
  const auto one = [&](auto f) { return asInt(type, [&](auto u) { return f(static_cast<decltype(u)>(a)); }); };
  const auto two = [&](auto f) {
    return asInt(type, [&](auto u) { return f(static_cast<decltype(u)>(a), static_cast<decltype(u)>(b())); });
  };
  const auto shift = [&](auto f) {
    return asInt(type, [&](auto u) { return f(static_cast<decltype(u)>(a), static_cast<uint32_t>(b())); });
  };
  const auto real = [&](int i) { return sem::fromBits(args[i]); };
  switch (code) {
  case OpCode::Add: return two([](auto x, auto y) { return sem::add(x, y); });
  case OpCode::Sub: return two([](auto x, auto y) { return sem::sub(x, y); });
  case OpCode::Mul: return two([](auto x, auto y) { return sem::mul(x, y); });
  case OpCode::DivS: return two([](auto x, auto y) { return sem::divS(x, y); });
  case OpCode::DivU: return two([](auto x, auto y) { return sem::divU(x, y); });
  case OpCode::RemS: return two([](auto x, auto y) { return sem::remS(x, y); });
  case OpCode::RemU: return two([](auto x, auto y) { return sem::remU(x, y); });
  case OpCode::Neg: return one([](auto x) { return sem::neg(x); });
  case OpCode::And: return a & b();
  case OpCode::Or: return a | b();
  case OpCode::Xor: return a ^ b();
  case OpCode::Not: return ~a & valueMask(type);
  case OpCode::Shl: return shift([](auto x, uint32_t n) { return sem::shl(x, n); });
  case OpCode::ShrU: return shift([](auto x, uint32_t n) { return sem::shrU(x, n); });
  case OpCode::ShrS: return shift([](auto x, uint32_t n) { return sem::shrS(x, n); });
  case OpCode::PopCount: return one([](auto x) { return sem::popCount(x); });
  case OpCode::BcdEncode: return one([](auto x) { return sem::bcdEncode(x); });
  case OpCode::BcdDecode: return one([](auto x) { return sem::bcdDecode(x); });
  case OpCode::Eq: return a == b() ? 1 : 0;
  case OpCode::Ne: return a != b() ? 1 : 0;
  case OpCode::LtS: return two([](auto x, auto y) { return sem::ltS(x, y); });
  case OpCode::LeS: return two([](auto x, auto y) { return sem::leS(x, y); });
  case OpCode::LtU: return a < b() ? 1 : 0;
  case OpCode::LeU: return a <= b() ? 1 : 0;
  case OpCode::Select: return a != 0 ? args[1] : args[2];
  case OpCode::ZExt: return a;
  case OpCode::SExt: return static_cast<uint64_t>(signedValue(first, a)) & valueMask(type);
  case OpCode::Trunc: return a & valueMask(type);
  case OpCode::FAdd: return sem::toBits(sem::fadd(real(0), real(1)));
  case OpCode::FSub: return sem::toBits(sem::fsub(real(0), real(1)));
  case OpCode::FMul: return sem::toBits(sem::fmul(real(0), real(1)));
  case OpCode::FDiv: return sem::toBits(sem::fdiv(real(0), real(1)));
  case OpCode::FNeg: return sem::toBits(sem::fneg(real(0)));
  case OpCode::FAbs: return sem::toBits(sem::fabs(real(0)));
#define RUNG_OP(name, text)
#define RUNG_EVALUABLE_OP(name, text)
#define RUNG_REAL_FUNCTION(name, function)                                                                             \
  case OpCode::name: return sem::toBits(sem::function(real(0)));
#include "ir/core/ops.def"
  case OpCode::FPow: return sem::toBits(sem::fpow(real(0), real(1)));
  case OpCode::FEq: return real(0) == real(1) ? 1 : 0;
  case OpCode::FLt: return real(0) < real(1) ? 1 : 0;
  case OpCode::FLe: return real(0) <= real(1) ? 1 : 0;
  case OpCode::FToInt: return asInt(type, [&](auto u) { return sem::fToInt<decltype(u)>(real(0)); });
  case OpCode::FToIntNearest: return sem::fToIntNearest(real(0));
  case OpCode::IntToF:
    return asInt(first, [&](auto u) { return sem::toBits(sem::intToF(static_cast<decltype(u)>(a))); });
  case OpCode::BitsToF:
  case OpCode::FToBits:
    return a;
// With effects, or a constant.
#define RUNG_OP(name, text) case OpCode::name:
#define RUNG_EVALUABLE_OP(name, text)
#include "ir/core/ops.def"
    break;
  }
  RUNG_CHECK(false, "not an operation that can be evaluated");
  return 0;
}

} // namespace rung::ir
