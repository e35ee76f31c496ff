// Arithmetic of ranges (see value_range.h). If a sum or a product may wrap around in some cases only, every value of
// the type is possible.
#include "ir/analysis/value_range.h"

#include <bit>
#include <optional>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

// Wraps bounds of numbers of at most 32 bits.
Range wrapped(int64_t low, int64_t high, Type type) {
  const auto size = static_cast<int64_t>(valueMask(type)) + 1;
  if (low < 0 && high < 0) return {static_cast<uint64_t>(low + size), static_cast<uint64_t>(high + size)};
  if (low >= size) return {static_cast<uint64_t>(low - size), static_cast<uint64_t>(high - size)};
  if (low < 0 || high >= size) return wholeRange(type);
  return {static_cast<uint64_t>(low), static_cast<uint64_t>(high)};
}

Range sum(Type type, const Range& a, const Range& b) {
  if (bitWidth(type) == 64)
    return b.high > valueMask(type) - a.high ? wholeRange(type) : Range{a.low + b.low, a.high + b.high};
  return wrapped(static_cast<int64_t>(a.low + b.low), static_cast<int64_t>(a.high + b.high), type);
}

Range difference(Type type, const Range& a, const Range& b) {
  if (bitWidth(type) == 64) return b.high > a.low ? wholeRange(type) : Range{a.low - b.high, a.high - b.low};
  return wrapped(static_cast<int64_t>(a.low) - static_cast<int64_t>(b.high),
                 static_cast<int64_t>(a.high) - static_cast<int64_t>(b.low), type);
}

Range product(Type type, const Range& a, const Range& b) {
  if (a.high != 0 && b.high > valueMask(type) / a.high) return wholeRange(type);
  return {a.low * b.low, a.high * b.high};
}

// A mask of all bits up to the highest that is set in a number.
uint64_t bitsBelow(uint64_t number) { return number == 0 ? 0 : ~0ull >> std::countl_zero(number); }

Range shiftedLeft(Type type, const Range& a, uint64_t count) {
  if (count >= bitWidth(type)) return {0, 0};
  return a.high > valueMask(type) >> count ? wholeRange(type) : Range{a.low << count, a.high << count};
}

Range shiftedRight(Type type, const Range& a, uint64_t count) {
  return count >= bitWidth(type) ? Range{0, 0} : Range{a.low >> count, a.high >> count};
}

constexpr Range kFalse{0, 0};
constexpr Range kTrue{1, 1};
constexpr Range kEither{0, 1};

Range less(const Range& a, const Range& b) {
  if (a.high < b.low) return kTrue;
  return a.low >= b.high ? kFalse : kEither;
}
Range lessOrEqual(const Range& a, const Range& b) {
  if (a.high <= b.low) return kTrue;
  return a.low > b.high ? kFalse : kEither;
}

// Maps signed numbers to the order of unsigned ones; nothing if the range has numbers of both signs.
std::optional<Range> signedOrder(Type type, const Range& a) {
  const uint64_t sign = (valueMask(type) >> 1) + 1;
  if ((a.low ^ a.high) & sign) return std::nullopt;
  return Range{a.low ^ sign, a.high ^ sign};
}

Range signedCompare(Type type, const Range& a, const Range& b, Range (*compare)(const Range&, const Range&)) {
  const std::optional<Range> x = signedOrder(type, a);
  const std::optional<Range> y = signedOrder(type, b);
  return x && y ? compare(*x, *y) : kEither;
}

// Two ranges of one number each are evaluated exactly instead.
Range distinct(const Range& a, const Range& b) { return a.high < b.low || b.high < a.low ? kTrue : kEither; }
Range like(const Range& a, const Range& b) { return distinct(a, b) == kTrue ? kFalse : kEither; }

Range chosen(const Range& cond, const Range& a, const Range& b) {
  if (cond.isOne()) return cond.low != 0 ? a : b;
  return a.joined(b);
}

bool allOne(const OpInfo& info, const Range* args) {
  for (int i = 0; i < info.fixed; ++i)
    if (!args[i].isOne()) return false;
  return true;
}

} // namespace

// NOLINTNEXTLINE(readability-function-size): a case for every operation that bounds are known of
Range rangeOf(const OpInfo& info, Type type, Type first, const Range* args) {
  if (isEvaluable(info) && allOne(info, args)) {
    uint64_t bits[3] = {0, 0, 0};
    for (int i = 0; i < info.fixed; ++i) bits[i] = args[i].low;
    const uint64_t value = evalPure(info.code, type, first, bits);
    return {value, value};
  }
  const Range& a = args[0];
  const Range& b = args[1];
  switch (info.code) {
  case OpCode::Add: return sum(type, a, b);
  case OpCode::Sub: return difference(type, a, b);
  case OpCode::Mul: return product(type, a, b);
  case OpCode::DivU: return b.isOne() && b.low != 0 ? Range{a.low / b.low, a.high / b.low} : Range{0, a.high};
  case OpCode::RemU:
    if (!b.isOne() || b.low == 0) return {0, a.high};
    return a.high < b.low ? a : Range{0, b.low - 1};
  case OpCode::And: return {0, std::min(a.high, b.high)};
  case OpCode::Or: return {std::max(a.low, b.low), bitsBelow(a.high | b.high)};
  case OpCode::Xor: return {0, bitsBelow(a.high | b.high)};
  case OpCode::Not: return {valueMask(type) - a.high, valueMask(type) - a.low};
  case OpCode::Shl: return b.isOne() ? shiftedLeft(type, a, b.low) : wholeRange(type);
  case OpCode::ShrU: return b.isOne() ? shiftedRight(type, a, b.low) : Range{0, a.high};
  case OpCode::PopCount: return {0, bitWidth(type)};
  case OpCode::Eq: return like(a, b);
  case OpCode::Ne: return distinct(a, b);
  case OpCode::LtU: return less(a, b);
  case OpCode::LeU: return lessOrEqual(a, b);
  case OpCode::LtS: return signedCompare(type, a, b, less);
  case OpCode::LeS: return signedCompare(type, a, b, lessOrEqual);
  case OpCode::Select: return chosen(a, b, args[2]);
  case OpCode::ZExt: return a;
  case OpCode::SExt: return a.high <= valueMask(first) >> 1 ? a : wholeRange(type);
  case OpCode::Trunc: return a.high <= valueMask(type) ? a : wholeRange(type);
  default: return wholeRange(resultType(info.result, type));
  }
}

} // namespace rung::ir
