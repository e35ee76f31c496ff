// Data instructions (man. ch. 3.9-3.16).
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "frontend/lower/operations.h"
#include "ir/core/ops.h"
#include "rtlib/nc/faults.h"

namespace rung::frontend::technol {

using ir::OpCode;
using ir::Type;
using ir::ValueId;

namespace {

Type widthOf(const Operand& operand) { return operand.given() ? operand.type : Type::I16; }

// A result that is not a number, or a division by zero, causes the coprocessor's fault.
ValueId checkedReal(Emitter& emitter, ValueId result, ValueId divisor = {}) {
  ir::RungBuilder& b = emitter.b();
  ValueId bad = b.not_(b.fEq(result, result));
  if (divisor.valid()) bad = b.or_(bad, b.fEq(divisor, b.real(0)));
  b.trap(bad, emitter.fault(nc::kTechnolReal));
  return result;
}

void realArithmetic(Lowering& l, const Operand& operand, int operation) {
  const ValueId right = l.memory.value(operand);
  const ValueId result = compute(l.b(), operation, l.r().real(), right);
  l.r().setReal(checkedReal(l.emitter, result, operation == kDivide ? right : ValueId{}));
}

// Twice the width, up to 64 bits: that of a product or dividend (man. l.1091-1132).
Type doubled(Type type) { return type == Type::I8 ? Type::I16 : type == Type::I16 ? Type::I32 : Type::I64; }

void multiply(Lowering& l, const Operand& operand) {
  ir::RungBuilder& b = l.b();
  const ValueId right = l.memory.value(operand);
  const Type wide = doubled(operand.type);
  const ValueId left = l.r().dr(operand.type);
  l.r().setDr(b.mul(b.sextOrTrunc(wide, left), b.sextOrTrunc(wide, right)));
}

// Divisors of 8, 16 and 32 bits divide 16, 32 and 64 bits of DR; the quotient must fit into 32 bits (man. l.1110-1132,
// l.5354).
void divide(Lowering& l, const Operand& operand) {
  ir::RungBuilder& b = l.b();
  const ValueId right = b.sextOrTrunc(Type::I64, l.memory.value(operand));
  const ValueId left = b.sextOrTrunc(Type::I64, l.r().dr(doubled(operand.type)));
  const ValueId quotient = b.divS(left, right);
  const ValueId fits = b.eq(b.sextOrTrunc(Type::I64, b.sextOrTrunc(Type::I32, quotient)), quotient);
  b.trap(b.or_(b.eq(right, b.constant(Type::I64, 0)), b.not_(fits)), l.emitter.fault(nc::kTechnolDivision));
  l.r().setDr(quotient);
}

void storeIf(Lowering& l, ValueId guard, const MemoryAccess& access, ValueId value) {
  l.b().when(guard, [&] { l.memory.store(access, value); });
}

} // namespace

void lowerLoad(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const ValueId value = l.memory.value(o[0]);
  if (o[0].isReal())
    l.r().setReal(o[0].negated ? b.fNeg(value) : value);
  else if (!o[0].negated)
    l.r().setDr(value);
  else
    l.r().setDr(b.neg(b.sextOrTrunc(Type::I64, value)));
}

void lowerStore(Lowering& l, std::span<const Operand> o, int condition) {
  const ValueId guard = l.guardOf(condition);
  const ValueId value = o[0].isReal() ? l.r().real() : l.r().dr(o[0].type);
  storeIf(l, guard, l.memory.reach(o[0], guard), value);
}

void lowerMove(Lowering& l, std::span<const Operand> o, int condition) {
  // A REAL is moved as its 64 bits.
  const Type type = o[0].isReal() ? Type::I64 : o[0].type;
  const ValueId guard = l.guardOf(condition);
  const MemoryAccess from = l.memory.reach(o[1], guard), to = l.memory.reach(o[0], guard);
  storeIf(l, guard, to, l.memory.load(from, type));
}

void lowerArithmetic(Lowering& l, std::span<const Operand> o, int operation) {
  if (o[0].isReal()) return realArithmetic(l, o[0], operation);
  if (operation == kMultiply) return multiply(l, o[0]);
  if (operation == kDivide) return divide(l, o[0]);
  const ValueId right = l.memory.value(o[0]);
  const ValueId left = l.r().dr(o[0].type);
  l.r().setDrPart(compute(l.b(), operation, left, right));
}

void lowerBitwise(Lowering& l, std::span<const Operand> o, int logic) {
  const ValueId right = l.memory.value(o[0]);
  l.r().setDrPart(combine(l.b(), logic, l.r().dr(o[0].type), right));
}

// EQ1 compares only if RLO is 1; otherwise RLO stays 0 (man. l.1404).
void lowerCompare(Lowering& l, std::span<const Operand> o, int relation) {
  const ValueId rlo = relation == kEqualIfRlo ? l.r().rlo() : ValueId{};
  const ValueId right = l.memory.value(o[0], rlo);
  const ValueId left = o[0].isReal() ? l.r().real() : l.r().dr(o[0].type);
  const ValueId result = compare(l.b(), relation == kEqualIfRlo ? kEqual : relation, left, right);
  l.r().setRlo(rlo.valid() ? l.b().and_(rlo, result) : result);
}

void lowerUnary(Lowering& l, std::span<const Operand> o, int operation) {
  ir::RungBuilder& b = l.b();
  const Type type = widthOf(o[0]);
  if (type == Type::F64) {
    const ValueId x = l.r().real();
    switch (static_cast<Unary>(operation)) {
    case kIncrement: return l.r().setReal(b.fAdd(x, b.real(1)));
    case kDecrement: return l.r().setReal(b.fSub(x, b.real(1)));
    case kNegate: return l.r().setReal(b.fNeg(x));
    case kAbsolute: return l.r().setReal(b.fAbs(x));
    }
  }
  const ValueId x = l.r().dr(type);
  switch (static_cast<Unary>(operation)) {
  case kIncrement: return l.r().setDrPart(b.add(x, b.constant(type, 1)));
  case kDecrement: return l.r().setDrPart(b.sub(x, b.constant(type, 1)));
  case kNegate: return l.r().setDrPart(b.neg(x));
  case kAbsolute: return l.r().setDrPart(b.select(b.ltS(x, b.constant(type, 0)), b.neg(x), x));
  }
}

// 0..9999 in 16 bits; 9999 is followed by 0 (man. l.1225).
void lowerIncrementBcd(Lowering& l, std::span<const Operand>, int) {
  ir::RungBuilder& b = l.b();
  const ValueId next = b.add(b.bcdDecode(l.r().dr(Type::I16)), b.constant(Type::I16, 1));
  l.r().setDrPart(b.bcdEncode(next));
}

// With DWRD bit 31 marks a negative number; the other bits are its magnitude (man. l.1250).
void lowerBin(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const Type type = widthOf(o[0]);
  const ValueId x = l.r().dr(type);
  if (type == Type::I16) return l.r().setDrPart(b.bcdDecode(x));
  const ValueId magnitude = b.bcdDecode(b.and_(x, b.constant(type, 0x7FFFFFFF)));
  l.r().setDrPart(b.select(b.ltS(x, b.constant(type, 0)), b.neg(magnitude), magnitude));
}

void lowerBcd(Lowering& l, std::span<const Operand> o, int) {
  const Type type = widthOf(o[0]);
  l.r().setDrPart(l.b().bcdEncode(l.r().dr(type)));
}

void lowerShift(Lowering& l, std::span<const Operand> o, int right) {
  ir::RungBuilder& b = l.b();
  const Type type = widthOf(o[1]);
  const ValueId count = b.zextOrTrunc(Type::I32, l.memory.value(o[0]));
  l.r().setDrPart(b.op(right ? OpCode::ShrU : OpCode::Shl, type, {l.r().dr(type), count}));
}

// The integer is first sign-extended to 64 bits and stays in DR (man. l.1511).
void lowerToReal(Lowering& l, std::span<const Operand> o, int) {
  const ValueId whole = l.b().sextOrTrunc(Type::I64, l.r().dr(widthOf(o[0])));
  l.r().setReal(l.b().intToF(whole));
  l.r().setDr(whole);
}

void lowerDrToRlo(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  if (o[0].form == Operand::Form::Integer) {
    const ValueId low = l.r().dr(Type::I32);
    const ValueId shifted = b.shrU(low, b.i32(o[0].value));
    return l.r().setRlo(b.trunc(Type::Bit, shifted));
  }
  const Type type = widthOf(o[0]);
  l.r().setRlo(b.ne(l.r().dr(type), b.constant(type, 0)));
}

// RLO = 1 gives FFFFh or FFFFFFFFh; the bits above are sign-extended.
void lowerRloToDr(Lowering& l, std::span<const Operand>, int) { l.r().setDr(l.b().sext(Type::I64, l.r().rlo())); }

void lowerMovBx(Lowering& l, std::span<const Operand>, int) {
  l.r().setBx(l.b().zextOrTrunc(Type::I32, l.r().dr(Type::I16)));
}

// Timers and counters (man. ch. 3.11).

using ir::Type;
using ir::ValueId;

// RLO = 0 clears the count; otherwise it counts up to the preset in DR, and RLO says whether it has reached it (man.
// l.884-916).
void lowerTimer(Lowering& l, std::span<const Operand> o, int) {
  ir::RungBuilder& b = l.b();
  const CountCell cell = l.countCell(o[0]);
  const ValueId rlo = l.r().rlo();
  const ValueId preset = l.r().dr(cell.type);
  l.addTimer(cell, preset);
  const auto run = [&] {
    const ValueId count = l.state.load(cell);
    const auto further = [&] {
      l.state.store(cell, b.add(count, b.constant(cell.type, 1)));
      return b.bit(false);
    };
    return b.choose(b.ltU(count, preset), further, [&] { return b.bit(true); });
  };
  const auto clear = [&] {
    l.state.store(cell, b.constant(cell.type, 0));
    return b.bit(false);
  };
  l.r().setRlo(b.choose(rlo, run, clear));
}

// Counts rising edges of RLO; then RLO says whether the count equals the preset in DR, and DR is the count (man.
// l.955-977).
void lowerCounter(Lowering& l, std::span<const Operand> o, int kind) {
  ir::RungBuilder& b = l.b();
  const CountCell cell = l.countCell(o[0]);
  const ir::SlotId former = l.ownSlot(Type::Bit);
  const ValueId rlo = l.r().rlo();
  const ValueId rises = edge(b, b.slotLoad(former), rlo);
  b.slotStore(former, rlo);
  const ValueId count = l.state.load(cell);
  const auto step = [&] {
    const ValueId one = b.constant(cell.type, 1);
    ValueId next = kind == kCountDown ? b.sub(count, one) : b.add(count, one);
    if (kind == kCountUpBcd) next = b.bcdEncode(b.add(b.bcdDecode(count), one));
    l.state.store(cell, next);
    return next;
  };
  const ValueId now = b.choose(rises, step, [&] { return count; });
  l.r().setRlo(b.eq(now, l.r().dr(cell.type)));
  l.r().setDr(b.zextOrTrunc(Type::I64, now));
}

} // namespace rung::frontend::technol
