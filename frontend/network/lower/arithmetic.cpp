// Arithmetic with the flags of the first result register (§6.5, §7.9, §7.12). It is computed in twice the width, where
// nothing overflows.
#include "frontend/lower/operations.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::network {
namespace {

using ir::Type;
using ir::ValueId;

// Offsets in the result registers.
constexpr uint32_t kFlags = 0;
constexpr uint32_t kRemainder = 2;

Type doubled(const Lowering& f) { return ir::intOfBytes(2 * f.function.length); }

// Stores the low bytes of a result and the flags; returns W, the overflow (P38).
ValueId storeResult(Lowering& f, const Address& address, ValueId wide) {
  ir::RungBuilder& b = f.b;
  const ValueId low = b.trunc(f.dataType(), wide);
  const ValueId overflow = b.ne(b.sextOrTrunc(doubled(f), low), wide);
  const ValueId zero = b.constant(doubled(f), 0);
  f.store(address, low);
  storeFlags(f, b.eq(wide, zero), b.ltS(wide, zero), overflow);
  return overflow;
}

ValueId wideOperand(Lowering& f, size_t i) { return f.b.sextOrTrunc(doubled(f), f.operand(i, f.dataType())); }

} // namespace

// P22: bit 0 zero, bit 1 negative, bit 5 overflow; the whole byte is rewritten. An invalid id means 0.
void storeFlags(Lowering& f, ValueId zero, ValueId negative, ValueId overflow) {
  ir::RungBuilder& b = f.b;
  ValueId byte = b.constant(Type::I8, 0);
  const auto add = [&](ValueId flag, int64_t bit) {
    if (flag.valid())
      byte = b.or_(byte, b.select(flag, b.constant(Type::I8, int64_t{1} << bit), b.constant(Type::I8, 0)));
  };
  add(zero, 0);
  add(negative, 1);
  add(overflow, 5);
  f.store(f.result(kFlags), byte);
}

void lowerArithmetic(Lowering& f) {
  f.resettable([&] {
    const ValueId a = wideOperand(f, 1);
    return storeResult(f, f.param(3).address, frontend::compute(f.b, f.variant(), a, wideOperand(f, 2)));
  });
}

// With a divisor of 0 only W changes (P38).
void lowerDivision(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    const ValueId a = wideOperand(f, 1);
    const ValueId divisor = wideOperand(f, 2);
    const auto divide = [&] {
      const ValueId remainder = b.trunc(f.dataType(), b.remS(a, divisor));
      const ValueId overflow = storeResult(f, f.param(3).address, b.divS(a, divisor));
      f.store(f.result(kRemainder), remainder);
      return overflow;
    };
    return b.choose(b.ne(divisor, b.constant(doubled(f), 0)), divide, [&] { return b.bit(true); });
  });
}

namespace {

// Signed binary to BCD; returns W: the magnitude has more digits than the length holds.
ValueId toBcd(Lowering& f, ValueId source) {
  constexpr int64_t kLimits[] = {0, 99, 9999, 0, 99999999};
  ir::RungBuilder& b = f.b;
  const ValueId negative = b.ltS(source, b.constant(f.dataType(), 0));
  const ValueId magnitude = b.select(negative, b.neg(source), source);
  const ValueId overflow = b.ltU(b.constant(f.dataType(), kLimits[f.function.length]), magnitude);
  f.b.when(b.not_(overflow), [&] { f.store(f.param(2).address, b.bcdEncode(magnitude)); });
  storeFlags(f, {}, negative, overflow);
  return overflow;
}

// BCD to binary; returns W: a digit is above 9, which shows because converting back gives another number.
ValueId fromBcd(Lowering& f, ValueId source, ValueId sign) {
  ir::RungBuilder& b = f.b;
  const ValueId magnitude = b.bcdDecode(source);
  const ValueId error = b.ne(b.bcdEncode(magnitude), source);
  const ValueId result = b.select(sign, b.neg(magnitude), magnitude);
  const ValueId good = b.not_(error);
  f.b.when(good, [&] { f.store(f.param(2).address, result); });
  storeFlags(f, {}, b.and_(good, b.ltS(result, b.constant(f.dataType(), 0))), {});
  return error;
}

} // namespace

// Conditions SIN, CNV, RST, ACT.
void lowerBcd(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    const ValueId source = f.load(f.dataType(), f.param(1).address);
    return b.choose(
        f.condition(1), [&] { return fromBcd(f, source, f.condition(0)); }, [&] { return toBcd(f, source); });
  });
}

} // namespace rung::frontend::network
