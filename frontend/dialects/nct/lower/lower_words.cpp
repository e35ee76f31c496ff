// Moves, logic and integer arithmetic (man. §6.3, §6.8, §6.9).
#include "frontend/dialects/nct/lower/lower.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::Type;
using ir::ValueId;

namespace {

// `compute` returns the result's value and sets the flags.
template <class Compute>
ValueId binary(Lowering& box, Compute compute) {
  return execute(box, [&] {
    ValueId valid;
    const Place result = box.memory.word(box.operands[0].address, AccessBound::Write);
    valid = result.valid;
    const ValueId a = box.memory.integer(box.operands[1], valid);
    const ValueId b = box.memory.integer(box.operands[2], valid);
    return guarded(box, valid, [&] {
      box.memory.storeWord(result, compute(a, b));
      return ValueId{};
    });
  });
}

// An invalid id means 0.
struct ArithmeticFlags {
  ValueId error;
  ValueId under;
  ValueId over;
  ValueId carry;
};

void setFlags(Memory& memory, const ArithmeticFlags& flags) {
  memory.setFlag(kFlagEr, flags.error);
  memory.setFlag(kFlagUf, flags.under);
  memory.setFlag(kFlagOf, flags.over);
  memory.setFlag(kFlagCy, flags.carry);
}

} // namespace

ValueId lowerMove(Lowering& box) {
  RungBuilder& b = box.b;
  return execute(box, [&] {
    const Place result = box.memory.word(box.operands[0].address, AccessBound::Write);
    ValueId valid = result.valid;
    const ValueId source = box.memory.integer(box.operands[1], valid);
    return guarded(box, valid, [&] {
      box.memory.storeWord(result, box.variant == kMoveComplement ? b.not_(source) : source);
      box.memory.setErrorFlag(false);
      return ValueId{};
    });
  });
}

// Moves the bit pattern, which preserves a NaN.
ValueId lowerMoveDouble(Lowering& box) {
  RungBuilder& b = box.b;
  return execute(box, [&] {
    const Place result = box.memory.twoWords(box.operands[0].address, AccessBound::Write);
    ValueId valid = result.valid;
    ValueId source;
    if (box.operands[1].form == Form::Constant) {
      source = b.fToBits(b.real(box.operands[1].constant.real));
    } else {
      const Place from = box.memory.twoWords(box.operands[1].address, AccessBound::Read);
      valid = box.memory.both(valid, from.valid);
      source = box.memory.loadDouble(from, Type::I64);
    }
    return guarded(box, valid, [&] {
      box.memory.storeDouble(result, source);
      box.memory.setErrorFlag(false);
      return ValueId{};
    });
  });
}

ValueId lowerLogic(Lowering& box) {
  return binary(box, [&](ValueId a, ValueId b) {
    box.memory.setErrorFlag(false);
    return frontend::combine(box.b, box.variant, a, b);
  });
}

// FL_CY is the unsigned carry or borrow. FL_OF: two positive operands give a negative result; FL_UF: the reverse
// (l.738-759). In both cases the exact result is outside the range of a word.
ValueId lowerAddSub(Lowering& box) {
  RungBuilder& b = box.b;
  return binary(box, [&](ValueId x, ValueId y) {
    const ValueId exact = frontend::compute(b, box.variant, b.sextOrTrunc(Type::I64, x), b.sextOrTrunc(Type::I64, y));
    const ValueId result = b.zextOrTrunc(Type::I32, exact);
    setFlags(box.memory, {.error = {},
                          .under = b.ltS(exact, b.constant(Type::I64, INT32_MIN)),
                          .over = b.ltS(b.constant(Type::I64, INT32_MAX), exact),
                          .carry = box.variant == kAdd ? b.ltU(result, x) : b.ltU(x, y)});
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
    setFlags(box.memory, {.error = {}, .under = {}, .over = over, .carry = {}});
    return result;
  });
}

// Divisor 0: the result is 0, FL_ER is set and the output stays off (l.1976, l.2113). -2147483648 / -1 overflows.
ValueId lowerDiv(Lowering& box) {
  RungBuilder& b = box.b;
  return execute(box, [&] {
    const Place result = box.memory.word(box.operands[0].address, AccessBound::Write);
    ValueId valid = result.valid;
    const ValueId x = box.memory.integer(box.operands[1], valid);
    const ValueId y = box.memory.integer(box.operands[2], valid);
    return guarded(box, valid, [&] {
      const ValueId zero = b.eq(y, b.i32(0));
      const ValueId over = b.and_(b.eq(x, b.i32(INT32_MIN)), b.eq(y, b.i32(-1)));
      box.memory.storeWord(result, b.divS(x, y));
      setFlags(box.memory, {.error = zero, .under = {}, .over = over, .carry = {}});
      return b.not_(zero);
    });
  });
}

// Comparisons of integers (man. §6.12): CMP, which sets flags, and the contacts CLT to CGT.

using ir::RungBuilder;
using ir::ValueId;

// Exactly one of FL_GT, FL_EQ, FL_LT is 1 afterwards.
ValueId lowerCompare(Lowering& box) {
  RungBuilder& b = box.b;
  execute(box, [&] {
    ValueId valid;
    const ValueId x = box.memory.integer(box.operands[0], valid);
    const ValueId y = box.memory.integer(box.operands[1], valid);
    return guarded(box, valid, [&] {
      box.memory.setErrorFlag(false);
      box.memory.setFlag(kFlagGt, b.ltS(y, x));
      box.memory.setFlag(kFlagEq, b.eq(x, y));
      box.memory.setFlag(kFlagLt, b.ltS(x, y));
      return ValueId{};
    });
  });
  return {};
}

ValueId lowerCompareContact(Lowering& box) {
  RungBuilder& b = box.b;
  ValueId valid;
  const ValueId x = box.memory.integer(box.operands[0], valid);
  const ValueId y = box.memory.integer(box.operands[1], valid);
  const ValueId holds = frontend::compare(b, box.variant, x, y);
  if (!valid.valid()) return box.pass(holds);
  box.memory.raiseErrorFlag(box.gate(b.not_(valid)));
  return box.pass(b.and_(holds, valid));
}

} // namespace rung::frontend::nct
