// The rules that simplify single operations (see simplify.h). Every rule is exact for all operands, to the bit; so
// there are no rules for floating-point sums and products, where NaN, signs of zero and rounding differ.
#include "ir/transforms/simplify.h"

#include "ir/core/eval.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

// The comparison with the opposite result; with the operands exchanged if `swap`.
struct Opposite {
  OpCode code;
  bool swap;
};
bool oppositeOf(OpCode code, Opposite& opposite) {
  if (code == OpCode::Eq)
    opposite = {OpCode::Ne, false};
  else if (code == OpCode::Ne)
    opposite = {OpCode::Eq, false};
  else if (code == OpCode::LtS)
    opposite = {OpCode::LeS, true};
  else if (code == OpCode::LeS)
    opposite = {OpCode::LtS, true};
  else if (code == OpCode::LtU)
    opposite = {OpCode::LeU, true};
  else if (code == OpCode::LeU)
    opposite = {OpCode::LtU, true};
  else
    return false;
  return true;
}

class Simplifier {
public:
  Simplifier(const Module& module, RungRewriter& writer, const Op& op) : module_(module), writer_(writer), op_(op) {
    if (op.argCount > 0) a_ = writer.mappedArg(op, 0);
    if (op.argCount > 1) b_ = writer.mappedArg(op, 1);
    if (op.argCount > 2) c_ = writer.mappedArg(op, 2);
  }

  bool run();

private:
  // Whether a value is the constant `bits`, compared in the operation's type.
  bool is(ValueId value, uint64_t bits) const {
    uint64_t known = 0;
    return isConstant(writer_, value, known) && known == bits;
  }
  uint64_t ones() const { return valueMask(op_.type); }
  const Op& def(ValueId value) const { return writer_.definition(value); }
  bool isA(ValueId value, OpCode code) const { return def(value).code == code; }
  ValueId inner(ValueId value, uint32_t i = 0) const { return writer_.arg(def(value), i); }
  bool complements(ValueId x, ValueId y) const {
    return (isA(x, OpCode::Not) && inner(x) == y) || (isA(y, OpCode::Not) && inner(y) == x);
  }
  bool hasOperand(ValueId value, OpCode code, ValueId operand) const {
    return isA(value, code) && (inner(value, 0) == operand || inner(value, 1) == operand);
  }
  void constantSecond() {
    if (isA(a_, OpCode::Const)) std::swap(a_, b_);
  }

  bool same(ValueId value) {
    writer_.replace(op_.result, value);
    return true;
  }
  bool constant(uint64_t bits) {
    return same(writer_.putConstant(op_, resultType(opInfo(op_.code).result, op_.type), bits));
  }
  bool become(OpCode code, Type type, std::initializer_list<ValueId> args) {
    writer_.put(op_, code, type, args);
    return true;
  }

  bool evaluate();
  bool logic(OpCode dual, uint64_t neutral, uint64_t absorbing);
  bool exclusiveOr();
  bool complement();
  bool arithmetic();
  bool sumOfConstants();
  bool quotient();
  bool remainder();
  bool shift();
  bool equality(bool equal);
  bool order();
  bool select();
  bool extend();
  bool truncate();
  bool window();

  const Module& module_;
  RungRewriter& writer_;
  const Op& op_;
  ValueId a_, b_, c_;
};

bool Simplifier::evaluate() {
  uint64_t bits[3] = {0, 0, 0};
  const ValueId args[3] = {a_, b_, c_};
  for (uint32_t i = 0; i < op_.argCount; ++i)
    if (!isConstant(writer_, args[i], bits[i])) return false;
  return constant(evalPure(op_.code, op_.type, writer_.type(a_), bits));
}

// And, or: each with its dual, its neutral and its absorbing constant.
bool Simplifier::logic(OpCode dual, uint64_t neutral, uint64_t absorbing) {
  constantSecond();
  if (a_ == b_ || is(b_, neutral)) return same(a_);
  if (is(b_, absorbing)) return same(b_);
  if (complements(a_, b_)) return constant(absorbing);
  if (hasOperand(a_, dual, b_) || hasOperand(b_, op_.code, a_)) return same(b_);
  if (hasOperand(b_, dual, a_) || hasOperand(a_, op_.code, b_)) return same(a_);
  return false;
}

bool Simplifier::exclusiveOr() {
  constantSecond();
  if (a_ == b_) return constant(0);
  if (is(b_, 0)) return same(a_);
  if (is(b_, ones())) return become(OpCode::Not, op_.type, {a_});
  return complements(a_, b_) && constant(ones());
}

bool Simplifier::complement() {
  if (isA(a_, OpCode::Not)) return same(inner(a_));
  Opposite opposite{};
  if (!oppositeOf(def(a_).code, opposite)) return false;
  const ValueId x = inner(a_, 0);
  const ValueId y = inner(a_, 1);
  return opposite.swap ? become(opposite.code, def(a_).type, {y, x}) : become(opposite.code, def(a_).type, {x, y});
}

bool Simplifier::arithmetic() {
  if (op_.code != OpCode::Sub) constantSecond();
  if (op_.code == OpCode::Mul) return is(b_, 0) ? same(b_) : is(b_, 1) && same(a_);
  if (is(b_, 0)) return same(a_);
  if (op_.code == OpCode::Add) return sumOfConstants();
  if (a_ == b_) return constant(0);
  return is(a_, 0) && become(OpCode::Neg, op_.type, {b_});
}

// x + c + d is x + (c + d).
bool Simplifier::sumOfConstants() {
  uint64_t outer = 0;
  if (!isConstant(writer_, b_, outer) || !isA(a_, OpCode::Add)) return false;
  for (uint32_t i = 0; i < 2; ++i) {
    uint64_t bits = 0;
    if (!isConstant(writer_, inner(a_, i), bits)) continue;
    const ValueId other = inner(a_, 1 - i);
    bits = (bits + outer) & ones();
    if (bits == 0) return same(other);
    return become(OpCode::Add, op_.type, {other, writer_.putConstant(op_, op_.type, bits)});
  }
  return false;
}

// Division by 0 gives 0.
bool Simplifier::quotient() {
  if (is(b_, 0)) return same(b_);
  return (is(a_, 0) || is(b_, 1)) && same(a_);
}

bool Simplifier::remainder() {
  if (is(b_, 0)) return same(b_);
  if (is(a_, 0)) return same(a_);
  return (a_ == b_ || is(b_, 1) || (op_.code == OpCode::RemS && is(b_, ones()))) && constant(0);
}

bool Simplifier::shift() {
  if (is(b_, 0) || is(a_, 0)) return same(a_);
  if (op_.code == OpCode::ShrS) return is(a_, ones()) && same(a_);
  uint64_t count = 0;
  return isConstant(writer_, b_, count) && count >= bitWidth(op_.type) && constant(0);
}

bool Simplifier::equality(bool equal) {
  constantSecond();
  if (a_ == b_) return constant(equal ? 1 : 0);
  if (complements(a_, b_)) return constant(equal ? 0 : 1);
  uint64_t bits = 0;
  if (!isConstant(writer_, b_, bits)) return false;
  // A bit, possibly widened, compared with a constant.
  ValueId bit = a_;
  if (isA(a_, OpCode::ZExt)) bit = inner(a_);
  if (writer_.type(bit) != Type::Bit) return false;
  if (bits > 1) return constant(equal ? 0 : 1);
  return (bits == 1) == equal ? same(bit) : become(OpCode::Not, Type::Bit, {bit});
}

bool Simplifier::order() {
  const bool strict = op_.code == OpCode::LtS || op_.code == OpCode::LtU;
  if (a_ == b_) return constant(strict ? 0 : 1);
  if (op_.code == OpCode::LtU) return (is(b_, 0) || is(a_, ones())) && constant(0);
  return op_.code == OpCode::LeU && (is(a_, 0) || is(b_, ones())) && constant(1);
}

bool Simplifier::select() {
  if (is(a_, 1) || b_ == c_) return same(b_);
  if (is(a_, 0)) return same(c_);
  if (op_.type == Type::Bit) {
    if (is(b_, 1)) return is(c_, 0) ? same(a_) : become(OpCode::Or, Type::Bit, {a_, c_});
    if (is(c_, 0)) return become(OpCode::And, Type::Bit, {a_, b_});
    if (is(b_, 0) && is(c_, 1)) return become(OpCode::Not, Type::Bit, {a_});
  }
  return isA(a_, OpCode::Not) && become(OpCode::Select, op_.type, {inner(a_), c_, b_});
}

bool Simplifier::extend() {
  if (isA(a_, OpCode::ZExt)) return become(OpCode::ZExt, op_.type, {inner(a_)});
  return op_.code == OpCode::SExt && isA(a_, OpCode::SExt) && become(OpCode::SExt, op_.type, {inner(a_)});
}

bool Simplifier::truncate() {
  const OpCode before = def(a_).code;
  if (before != OpCode::ZExt && before != OpCode::SExt && before != OpCode::Trunc) return false;
  const ValueId source = inner(a_);
  const uint32_t from = bitWidth(writer_.type(source));
  if (from == bitWidth(op_.type)) return same(source);
  return become(from > bitWidth(op_.type) ? OpCode::Trunc : before, op_.type, {source});
}

// An element with a known index is a fixed place; one outside the window reads 0 and is not written.
bool Simplifier::window() {
  const bool bit = op_.code == OpCode::LoadBitAt || op_.code == OpCode::StoreBitAt;
  const bool load = op_.code == OpCode::LoadAt || op_.code == OpCode::LoadBitAt;
  uint64_t index = 0;
  uint64_t bitNumber = 0;
  if (!isConstant(writer_, a_, index) || (bit && !isConstant(writer_, b_, bitNumber))) return false;
  const uint64_t unitBits = uint64_t{module_.spaces[op_.ref].unitBytes} * 8;
  if (index >= op_.count || (bit && bitNumber >= unitBits)) return !load || constant(0);
  const ValueId stored = bit ? c_ : b_;
  Op& written =
      load ? writer_.put(op_, OpCode::Load, op_.type, {}) : writer_.put(op_, OpCode::Store, op_.type, {stored});
  written.ref = op_.ref;
  written.imm = op_.imm + static_cast<int64_t>(index * unitBits + bitNumber);
  return true;
}

// NOLINTNEXTLINE(readability-function-size): a case for every operation with a rule
bool Simplifier::run() {
  if (isEvaluable(opInfo(op_.code)) && evaluate()) return true;
  switch (op_.code) {
  case OpCode::And: return logic(OpCode::Or, ones(), 0);
  case OpCode::Or: return logic(OpCode::And, 0, ones());
  case OpCode::Xor: return exclusiveOr();
  case OpCode::Not: return complement();
  case OpCode::Add:
  case OpCode::Sub:
  case OpCode::Mul: return arithmetic();
  case OpCode::DivS:
  case OpCode::DivU: return quotient();
  case OpCode::RemS:
  case OpCode::RemU: return remainder();
  case OpCode::Neg: return isA(a_, OpCode::Neg) && same(inner(a_));
  case OpCode::Shl:
  case OpCode::ShrU:
  case OpCode::ShrS: return shift();
  case OpCode::Eq: return equality(true);
  case OpCode::Ne: return equality(false);
  case OpCode::LtS:
  case OpCode::LeS:
  case OpCode::LtU:
  case OpCode::LeU: return order();
  case OpCode::Select: return select();
  case OpCode::ZExt:
  case OpCode::SExt: return extend();
  case OpCode::Trunc: return truncate();
  case OpCode::FNeg: return isA(a_, OpCode::FNeg) && same(inner(a_));
  case OpCode::FAbs:
    if (isA(a_, OpCode::FAbs)) return same(a_);
    return isA(a_, OpCode::FNeg) && become(OpCode::FAbs, op_.type, {inner(a_)});
  case OpCode::BitsToF: return isA(a_, OpCode::FToBits) && same(inner(a_));
  case OpCode::FToBits: return isA(a_, OpCode::BitsToF) && same(inner(a_));
  case OpCode::LoadAt:
  case OpCode::StoreAt:
  case OpCode::LoadBitAt:
  case OpCode::StoreBitAt: return window();
  case OpCode::Trap: return is(a_, 0);
  default: return false; // only constants are folded
  }
}

} // namespace

bool simplify(const Module& module, RungRewriter& writer, const Op& op) { return Simplifier(module, writer, op).run(); }

} // namespace rung::ir
