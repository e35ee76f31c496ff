// Floating-point arithmetic and conversions (man. §6.10, §6.11).
#include <limits>
#include <numbers>

#include "frontend/dialects/nct/lower/lower.h"
#include "ir/core/ops.h"

namespace rung::frontend::nct {

using ir::OpCode;
using ir::RungBuilder;
using ir::Type;
using ir::ValueId;

namespace {

ValueId isFinite(RungBuilder& b, ValueId x) {
  const ValueId magnitude = b.fAbs(x);
  return b.fLe(magnitude, b.real(std::numeric_limits<double>::max()));
}
ValueId isZero(RungBuilder& b, ValueId x) { return b.fEq(x, b.real(0)); }
ValueId isNumber(RungBuilder& b, ValueId x) { return b.fEq(x, x); }

// Emits `store`, which clears FL_ER, if `ok` holds; otherwise sets only FL_ER. Returns `ok`.
template <class Store>
ValueId when(Lowering& box, ValueId ok, Store store) {
  box.b.when(ok, store, [&] { box.memory.setErrorFlag(true); });
  return ok;
}

// Underflow: the result is 0 although the exact result is not (l.694-704). Sums of doubles this small are exact.
ValueId underflows(RungBuilder& b, int operation, ValueId x, ValueId y, ValueId result) {
  switch (operation) {
  case kMultiply: return b.and_(isZero(b, result), b.not_(b.or_(isZero(b, x), isZero(b, y))));
  case kDivide: return b.and_(isZero(b, result), b.and_(b.not_(isZero(b, x)), isFinite(b, y)));
  default: return b.bit(false);
  }
}

} // namespace

// Overflow: finite operands, infinite result. An operation with a NaN operand or result (∞ - ∞), or a division by 0, is
// not executed. The common case is tested first: a finite result that, for products and quotients, is not 0. It sets
// none of these flags.
ValueId lowerFloatArithmetic(Lowering& box) {
  RungBuilder& b = box.b;
  const int operation = box.variant;
  return execute(box, [&] {
    const Place target = box.memory.twoWords(box.operands[0].address, AccessBound::Write);
    ValueId valid = target.valid;
    const ValueId x = box.memory.real(box.operands[1], valid);
    const ValueId y = box.memory.real(box.operands[2], valid);
    return guarded(box, valid, [&] {
      const ValueId result = frontend::compute(b, operation, x, y);
      const auto put = [&](ValueId under, ValueId over) {
        box.memory.storeDouble(target, result);
        box.memory.setErrorFlag(false);
        box.memory.setFlag(kFlagUf, under);
        box.memory.setFlag(kFlagOf, over);
      };
      const auto putOrdinary = [&] {
        put(b.bit(false), b.bit(false));
        return b.bit(true);
      };
      const auto putOther = [&] {
        ValueId ok = isNumber(b, result);
        if (operation == kDivide) ok = b.and_(ok, b.not_(isZero(b, y)));
        return when(box, ok, [&] {
          const ValueId over = b.and_(b.and_(isFinite(b, x), isFinite(b, y)), b.not_(isFinite(b, result)));
          put(underflows(b, operation, x, y, result), over);
        });
      };
      ValueId ordinary = isFinite(b, result);
      if (operation == kMultiply || operation == kDivide) ordinary = b.and_(ordinary, b.not_(isZero(b, result)));
      return b.choose(ordinary, putOrdinary, putOther);
    });
  });
}

// The operations return NaN where they are undefined; the manual also forbids the logarithm of 0, and powers of a
// negative base or of 0 to a negative exponent (§6.10.5-§6.10.14). Only powers and exponentials can exceed the range of
// doubles.
ValueId lowerFloatFunction(Lowering& box) {
  constexpr OpCode kCodes[] = {OpCode::FPow,  OpCode::FSqrt, OpCode::FSin,  OpCode::FCos, OpCode::FTan,
                               OpCode::FAsin, OpCode::FAcos, OpCode::FAtan, OpCode::FExp, OpCode::FLog};
  RungBuilder& b = box.b;
  return execute(box, [&] {
    const auto variant = static_cast<FunctionVariant>(box.variant);
    const Place target = box.memory.twoWords(box.operands[0].address, AccessBound::Write);
    ValueId valid = target.valid;
    const ValueId x = box.memory.real(box.operands[1], valid);
    const ValueId y = variant == kPower ? box.memory.real(box.operands[2], valid) : ValueId{};
    return guarded(box, valid, [&] {
      const ValueId zero = b.real(0);
      const ValueId result =
          variant == kPower ? b.op(OpCode::FPow, Type::F64, {x, y}) : b.op(kCodes[variant], Type::F64, {x});
      ValueId ok = isNumber(b, result);
      if (variant == kLogarithm) ok = b.fLt(zero, x);
      if (variant == kPower) {
        const ValueId pole = b.and_(isZero(b, x), b.fLt(y, zero));
        ok = b.and_(b.and_(isNumber(b, y), b.fLe(zero, x)), b.not_(pole));
      }
      return when(box, ok, [&] {
        box.memory.storeDouble(target, result);
        ValueId over;
        ValueId under;
        if (variant == kPower || variant == kExponential) {
          const ValueId finite = y.valid() ? b.and_(isFinite(b, x), isFinite(b, y)) : isFinite(b, x);
          over = b.and_(finite, b.not_(isFinite(b, result)));
          under = b.and_(finite, isZero(b, result));
          if (variant == kPower) under = b.and_(under, b.not_(isZero(b, x)));
        }
        box.memory.setErrorFlag(false);
        box.memory.setFlag(kFlagUf, under);
        box.memory.setFlag(kFlagOf, over);
      });
    });
  });
}

namespace {

// Converts a word to a word; `convert` returns the result and whether it exists.
template <class Convert>
ValueId convertWord(Lowering& box, Convert convert) {
  return execute(box, [&] {
    const Place target = box.memory.word(box.operands[0].address, AccessBound::Write);
    ValueId valid = target.valid;
    const ValueId source = box.memory.integer(box.operands[1], valid);
    return guarded(box, valid, [&] {
      const auto [result, ok] = convert(source);
      return when(box, ok, [&] {
        box.memory.storeWord(target, result);
        box.memory.setErrorFlag(false);
      });
    });
  });
}

struct Converted {
  ValueId result;
  ValueId ok;
};

} // namespace

// BIN: a digit above 9 is detected because converting back gives another number.
ValueId lowerBin(Lowering& box) {
  RungBuilder& b = box.b;
  return convertWord(box, [&](ValueId source) {
    const ValueId binary = b.bcdDecode(source);
    return Converted{binary, b.eq(b.bcdEncode(binary), source)};
  });
}

ValueId lowerBcd(Lowering& box) {
  RungBuilder& b = box.b;
  return convertWord(box,
                     [&](ValueId source) { return Converted{b.bcdEncode(source), b.leU(source, b.i32(99'999'999))}; });
}

ValueId lowerFlt(Lowering& box) {
  RungBuilder& b = box.b;
  return execute(box, [&] {
    const Place target = box.memory.twoWords(box.operands[0].address, AccessBound::Write);
    ValueId valid = target.valid;
    const ValueId source = box.memory.integer(box.operands[1], valid);
    return guarded(box, valid, [&] {
      box.memory.storeDouble(target, b.intToF(source));
      box.memory.setErrorFlag(false);
      return ValueId{};
    });
  });
}

// The range applies to the operand itself, before its fraction is cut off (l.2505).
ValueId lowerFix(Lowering& box) {
  RungBuilder& b = box.b;
  return execute(box, [&] {
    const Place target = box.memory.word(box.operands[0].address, AccessBound::Write);
    ValueId valid = target.valid;
    const ValueId source = box.memory.real(box.operands[1], valid);
    return guarded(box, valid, [&] {
      const ValueId aboveLeast = b.fLe(b.real(INT32_MIN), source);
      const ValueId belowGreatest = b.fLe(source, b.real(INT32_MAX));
      return when(box, b.and_(aboveLeast, belowGreatest), [&] {
        box.memory.storeWord(target, b.op(OpCode::FToInt, Type::I32, {source}));
        box.memory.setErrorFlag(false);
      });
    });
  });
}

ValueId lowerAngle(Lowering& box) {
  RungBuilder& b = box.b;
  return execute(box, [&] {
    const Place target = box.memory.twoWords(box.operands[0].address, AccessBound::Write);
    ValueId valid = target.valid;
    const ValueId source = box.memory.real(box.operands[1], valid);
    const double factor = box.variant == kToDegrees ? 180 / std::numbers::pi : std::numbers::pi / 180;
    return guarded(box, valid, [&] {
      return when(box, isNumber(b, source), [&] {
        box.memory.storeDouble(target, b.fMul(source, b.real(factor)));
        box.memory.setErrorFlag(false);
      });
    });
  });
}

// A NaN clears all three flags and sets FL_ER.
ValueId lowerFloatCompare(Lowering& box) {
  RungBuilder& b = box.b;
  execute(box, [&] {
    ValueId valid;
    const ValueId x = box.memory.real(box.operands[0], valid);
    const ValueId y = box.memory.real(box.operands[1], valid);
    return guarded(box, valid, [&] {
      const auto test = [&](OpCode code, ValueId p, ValueId q) { return b.op(code, Type::F64, {p, q}); };
      const ValueId greater = test(OpCode::FLt, y, x);
      const ValueId equal = test(OpCode::FEq, x, y);
      const ValueId less = test(OpCode::FLt, x, y);
      box.memory.setFlag(kFlagEr, b.not_(b.or_(b.or_(greater, equal), less)));
      box.memory.setFlag(kFlagGt, greater);
      box.memory.setFlag(kFlagEq, equal);
      box.memory.setFlag(kFlagLt, less);
      return ValueId{};
    });
  });
  return {};
}

// A NaN is an error like an address outside the memory: no power, FL_ER is set.
ValueId lowerFloatContact(Lowering& box) {
  RungBuilder& b = box.b;
  ValueId valid;
  const ValueId x = box.memory.real(box.operands[0], valid);
  const ValueId y = box.memory.real(box.operands[1], valid);
  valid = box.memory.both(valid, b.and_(isNumber(b, x), isNumber(b, y)));
  const ValueId holds = frontend::compare(b, box.variant, x, y);
  box.memory.raiseErrorFlag(box.gate(b.not_(valid)));
  return box.pass(b.and_(holds, valid));
}

} // namespace rung::frontend::nct
