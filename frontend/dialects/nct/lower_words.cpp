// Moving, logic and integer arithmetic (man. §6.3, §6.8, §6.9).
#include "frontend/dialects/nct/lowering.h"

namespace rung::nct {

using ir::OpCode;
using ir::RungBuilder;
using ir::Type;
using ir::ValueId;

namespace {

// `compute` gives the result's value and sets the flags.
template <class Compute>
ValueId binary(Lowering& box, Compute compute) {
  ValueId valid;
  const Place result = box.memory.word(box.operands[0].address, Reach::Write);
  valid = result.valid;
  const ValueId a = box.memory.integer(box.operands[1], valid);
  const ValueId b = box.memory.integer(box.operands[2], valid);
  return execute(box, valid, [&] {
    box.memory.storeWord(result, compute(a, b));
    return ValueId{};
  });
}

// Bit 31 of `word` as the flag 1 << bit.
ValueId signAs(RungBuilder& b, ValueId word, int bit, uint8_t flag) {
  return b.and_(b.op(OpCode::ShrU, Type::I32, {word, b.i32(31 - bit)}), b.i32(flag));
}

} // namespace

ValueId lowerMove(Lowering& box) {
  RungBuilder& b = box.b;
  const Place result = box.memory.word(box.operands[0].address, Reach::Write);
  ValueId valid = result.valid;
  const ValueId source = box.memory.integer(box.operands[1], valid);
  return execute(box, valid, [&] {
    box.memory.storeWord(result, box.variant == kMoveComplement ? b.not_(source) : source);
    box.memory.setErrorFlag(false);
    return ValueId{};
  });
}

// The bit pattern, also of a NaN.
ValueId lowerMoveDouble(Lowering& box) {
  RungBuilder& b = box.b;
  const Place result = box.memory.twoWords(box.operands[0].address, Reach::Write);
  ValueId valid = result.valid;
  ValueId source;
  if (box.operands[1].form == Form::Constant) {
    source = b.op(OpCode::FToBits, Type::I64, {b.real(box.operands[1].constant.real)});
  } else {
    const Place from = box.memory.twoWords(box.operands[1].address, Reach::Read);
    valid = box.memory.both(valid, from.valid);
    source = box.memory.loadDouble(from, Type::I64);
  }
  return execute(box, valid, [&] {
    box.memory.storeDouble(result, source);
    box.memory.setErrorFlag(false);
    return ValueId{};
  });
}

ValueId lowerLogic(Lowering& box) {
  constexpr OpCode kCodes[] = {OpCode::And, OpCode::Or, OpCode::Xor};
  return binary(box, [&](ValueId a, ValueId b) {
    box.memory.setErrorFlag(false);
    return box.b.binary(kCodes[box.variant], a, b);
  });
}

// FL_CY is the unsigned carry or borrow. FL_OF: two numbers without sign give one with it; FL_UF: the other way round
// (l.738-759).
ValueId lowerAddSub(Lowering& box) {
  RungBuilder& b = box.b;
  return binary(box, [&](ValueId x, ValueId y) {
    const bool add = box.variant == kAdd;
    const ValueId result = add ? b.add(x, y) : b.sub(x, y);
    const ValueId carry = add ? b.ltU(result, x) : b.ltU(x, y);
    // The sign that the second operand would bring into a sum.
    const ValueId sign = add ? y : b.not_(y);
    const ValueId under = b.and_(b.and_(x, sign), b.not_(result));
    const ValueId over = b.and_(b.not_(b.or_(x, sign)), result);
    const ValueId flags = b.or_(b.or_(signAs(b, under, 1, kFlagUf), signAs(b, over, 2, kFlagOf)),
                                b.select(carry, b.i32(kFlagCy), b.i32(0)));
    box.memory.setFlags(kFlagEr | kFlagUf | kFlagOf | kFlagCy, b.zextOrTrunc(Type::I8, flags));
    return result;
  });
}

// FL_OF: the product does not fit into 32 bits (l.2090).
ValueId lowerMul(Lowering& box) {
  RungBuilder& b = box.b;
  return binary(box, [&](ValueId x, ValueId y) {
    const ValueId wide = b.mul(b.sextOrTrunc(Type::I64, x), b.sextOrTrunc(Type::I64, y));
    const ValueId result = b.zextOrTrunc(Type::I32, wide);
    const ValueId over = b.ne(b.sextOrTrunc(Type::I64, result), wide);
    box.memory.setFlags(kFlagEr | kFlagUf | kFlagOf | kFlagCy,
                        b.select(over, b.constant(Type::I8, kFlagOf), b.constant(Type::I8, 0)));
    return result;
  });
}

// Divisor 0: the result is 0, FL_ER is set and the output stays off (l.1976, l.2113). -2147483648 / -1 overflows.
ValueId lowerDiv(Lowering& box) {
  RungBuilder& b = box.b;
  const Place result = box.memory.word(box.operands[0].address, Reach::Write);
  ValueId valid = result.valid;
  const ValueId x = box.memory.integer(box.operands[1], valid);
  const ValueId y = box.memory.integer(box.operands[2], valid);
  return execute(box, valid, [&] {
    const ValueId zero = b.eq(y, b.i32(0));
    const ValueId over = b.and_(b.eq(x, b.i32(INT32_MIN)), b.eq(y, b.i32(-1)));
    box.memory.storeWord(result, b.op(OpCode::DivS, Type::I32, {x, y}));
    const ValueId none = b.constant(Type::I8, 0);
    const ValueId flags =
        b.select(zero, b.constant(Type::I8, kFlagEr), b.select(over, b.constant(Type::I8, kFlagOf), none));
    box.memory.setFlags(kFlagEr | kFlagUf | kFlagOf | kFlagCy, flags);
    return b.not_(zero);
  });
}

} // namespace rung::nct
