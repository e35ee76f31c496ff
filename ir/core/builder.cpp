// The rung builder (see builder.h).
#include "ir/core/builder.h"

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/check.h"

namespace rung::ir {

Op& RungBuilder::append(OpCode code, Type type, std::span<const ValueId> args) {
  Op op;
  op.code = code;
  op.type = type;
  op.argCount = static_cast<uint16_t>(args.size());
  op.firstArg = static_cast<uint32_t>(rung_.args.size());
  op.line = line_;
  rung_.args.insert(rung_.args.end(), args.begin(), args.end());
  checkArgs(op);
  rung_.ops.push_back(op);
  return rung_.ops.back();
}

void RungBuilder::checkArgs(const Op& op) const {
  const OpInfo& info = opInfo(op.code);
  RUNG_CHECK(contains(info.types, op.type), "operation of a type it does not have");
  const int fixed = info.fixed;
  RUNG_CHECK(isVariadic(info) ? op.argCount >= fixed : op.argCount == fixed, "wrong number of operands");
  for (int i = 0; i < fixed; ++i)
    RUNG_CHECK(satisfies(info.operands[static_cast<size_t>(i)], op.type, typeOf(arg(rung_, op, i))),
               "operand of the wrong type");
}

ValueId RungBuilder::newResult(Op& op, Type type) {
  const ValueId id{static_cast<uint32_t>(rung_.values.size())};
  rung_.values.push_back(type);
  if (op.resultCount == 0) op.result = id;
  ++op.resultCount;
  return id;
}

ValueId RungBuilder::op(OpCode code, Type type, std::initializer_list<ValueId> args) {
  Op& added = append(code, type, {args.begin(), args.size()});
  const Type result = resultType(opInfo(code).result, type);
  return result == Type::None ? ValueId{} : newResult(added, result);
}

ValueId RungBuilder::add(ValueId a, ValueId b) { return binary(OpCode::Add, a, b); }
ValueId RungBuilder::sub(ValueId a, ValueId b) { return binary(OpCode::Sub, a, b); }
ValueId RungBuilder::mul(ValueId a, ValueId b) { return binary(OpCode::Mul, a, b); }
ValueId RungBuilder::and_(ValueId a, ValueId b) { return binary(OpCode::And, a, b); }
ValueId RungBuilder::or_(ValueId a, ValueId b) { return binary(OpCode::Or, a, b); }
ValueId RungBuilder::xor_(ValueId a, ValueId b) { return binary(OpCode::Xor, a, b); }
ValueId RungBuilder::not_(ValueId a) { return op(OpCode::Not, typeOf(a), {a}); }
ValueId RungBuilder::eq(ValueId a, ValueId b) { return binary(OpCode::Eq, a, b); }
ValueId RungBuilder::ne(ValueId a, ValueId b) { return binary(OpCode::Ne, a, b); }
ValueId RungBuilder::ltS(ValueId a, ValueId b) { return binary(OpCode::LtS, a, b); }
ValueId RungBuilder::leS(ValueId a, ValueId b) { return binary(OpCode::LeS, a, b); }
ValueId RungBuilder::ltU(ValueId a, ValueId b) { return binary(OpCode::LtU, a, b); }
ValueId RungBuilder::leU(ValueId a, ValueId b) { return binary(OpCode::LeU, a, b); }
ValueId RungBuilder::shl(ValueId a, ValueId count) { return binary(OpCode::Shl, a, count); }
ValueId RungBuilder::shrU(ValueId a, ValueId count) { return binary(OpCode::ShrU, a, count); }
ValueId RungBuilder::divS(ValueId a, ValueId b) { return binary(OpCode::DivS, a, b); }
ValueId RungBuilder::divU(ValueId a, ValueId b) { return binary(OpCode::DivU, a, b); }
ValueId RungBuilder::remS(ValueId a, ValueId b) { return binary(OpCode::RemS, a, b); }
ValueId RungBuilder::remU(ValueId a, ValueId b) { return binary(OpCode::RemU, a, b); }
ValueId RungBuilder::fAdd(ValueId a, ValueId b) { return binary(OpCode::FAdd, a, b); }
ValueId RungBuilder::fSub(ValueId a, ValueId b) { return binary(OpCode::FSub, a, b); }
ValueId RungBuilder::fMul(ValueId a, ValueId b) { return binary(OpCode::FMul, a, b); }
ValueId RungBuilder::fEq(ValueId a, ValueId b) { return binary(OpCode::FEq, a, b); }
ValueId RungBuilder::fLt(ValueId a, ValueId b) { return binary(OpCode::FLt, a, b); }
ValueId RungBuilder::fLe(ValueId a, ValueId b) { return binary(OpCode::FLe, a, b); }
ValueId RungBuilder::neg(ValueId a) { return op(OpCode::Neg, typeOf(a), {a}); }
ValueId RungBuilder::popCount(ValueId a) { return op(OpCode::PopCount, typeOf(a), {a}); }
ValueId RungBuilder::bcdEncode(ValueId a) { return op(OpCode::BcdEncode, typeOf(a), {a}); }
ValueId RungBuilder::bcdDecode(ValueId a) { return op(OpCode::BcdDecode, typeOf(a), {a}); }
ValueId RungBuilder::fNeg(ValueId a) { return op(OpCode::FNeg, typeOf(a), {a}); }
ValueId RungBuilder::fAbs(ValueId a) { return op(OpCode::FAbs, typeOf(a), {a}); }
ValueId RungBuilder::trunc(Type type, ValueId a) { return op(OpCode::Trunc, type, {a}); }
ValueId RungBuilder::sext(Type type, ValueId a) { return op(OpCode::SExt, type, {a}); }
ValueId RungBuilder::bitsToF(ValueId bits) { return op(OpCode::BitsToF, Type::F64, {bits}); }
ValueId RungBuilder::fToBits(ValueId real) { return op(OpCode::FToBits, Type::I64, {real}); }
ValueId RungBuilder::intToF(ValueId integer) { return op(OpCode::IntToF, Type::F64, {integer}); }
ValueId RungBuilder::select(ValueId cond, ValueId a, ValueId b) { return op(OpCode::Select, typeOf(a), {cond, a, b}); }
ValueId RungBuilder::zextOrTrunc(Type type, ValueId a) { return resize(OpCode::ZExt, type, a); }
ValueId RungBuilder::sextOrTrunc(Type type, ValueId a) { return resize(OpCode::SExt, type, a); }
ValueId RungBuilder::now() { return op(OpCode::Now, Type::I64, {}); }

ValueId RungBuilder::constant(Type type, int64_t value) {
  Op& added = append(OpCode::Const, type, {});
  const uint32_t width = bitWidth(type);
  added.imm = width >= 64 ? value : static_cast<int64_t>(static_cast<uint64_t>(value) & ((1ull << width) - 1));
  return newResult(added, type);
}

ValueId RungBuilder::real(double value) { return constant(Type::F64, std::bit_cast<int64_t>(value)); }

ValueId RungBuilder::resize(OpCode widen, Type type, ValueId a) {
  const uint32_t from = bitWidth(typeOf(a));
  if (from == bitWidth(type)) return a;
  return op(from < bitWidth(type) ? widen : OpCode::Trunc, type, {a});
}

ValueId RungBuilder::load(Type type, Place place) {
  Op& added = append(OpCode::Load, type, {});
  added.ref = place.space.index;
  added.imm = static_cast<int64_t>(place.byte) * 8 + place.bit;
  return newResult(added, type);
}

void RungBuilder::store(Place place, ValueId value) {
  Op& added = append(OpCode::Store, typeOf(value), {&value, 1});
  added.ref = place.space.index;
  added.imm = static_cast<int64_t>(place.byte) * 8 + place.bit;
}

ValueId RungBuilder::loadAt(Type type, Window window, ValueId index) {
  Op& added = append(OpCode::LoadAt, type, {&index, 1});
  added.ref = window.space.index;
  added.imm = static_cast<int64_t>(window.byte) * 8;
  added.count = window.count;
  return newResult(added, type);
}

void RungBuilder::storeAt(Window window, ValueId index, ValueId value) {
  const ValueId args[] = {index, value};
  Op& added = append(OpCode::StoreAt, typeOf(value), args);
  added.ref = window.space.index;
  added.imm = static_cast<int64_t>(window.byte) * 8;
  added.count = window.count;
}

ValueId RungBuilder::loadBitAt(Window window, ValueId index, ValueId bitNumber) {
  const ValueId args[] = {index, bitNumber};
  Op& added = append(OpCode::LoadBitAt, Type::Bit, args);
  added.ref = window.space.index;
  added.imm = static_cast<int64_t>(window.byte) * 8;
  added.count = window.count;
  return newResult(added, Type::Bit);
}

void RungBuilder::storeBitAt(Window window, ValueId index, ValueId bitNumber, ValueId value) {
  const ValueId args[] = {index, bitNumber, value};
  Op& added = append(OpCode::StoreBitAt, Type::Bit, args);
  added.ref = window.space.index;
  added.imm = static_cast<int64_t>(window.byte) * 8;
  added.count = window.count;
}

ValueId RungBuilder::slotLoad(SlotId slot) {
  const Type type = module_.at(slot).type;
  Op& added = append(OpCode::SlotLoad, type, {});
  added.ref = slot.index;
  return newResult(added, type);
}

void RungBuilder::slotStore(SlotId slot, ValueId value) {
  RUNG_CHECK(module_.at(slot).type == typeOf(value), "slot of another type");
  append(OpCode::SlotStore, typeOf(value), {&value, 1}).ref = slot.index;
}

void RungBuilder::if_(ValueId cond, BranchWeights branchWeights) {
  append(OpCode::If, Type::None, {&cond, 1}).ref = branchWeights;
  yieldTypes_.emplace_back();
}

void RungBuilder::else_(std::span<const ValueId> yields) {
  RUNG_CHECK(!yieldTypes_.empty(), "else without if");
  append(OpCode::Else, Type::None, yields);
  for (ValueId id : yields) yieldTypes_.back().push_back(typeOf(id));
}

std::vector<ValueId> RungBuilder::endIf(std::span<const ValueId> yields) {
  RUNG_CHECK(!yieldTypes_.empty(), "endif without if");
  const std::vector<Type> types = std::move(yieldTypes_.back());
  yieldTypes_.pop_back();
  RUNG_CHECK(types.size() == yields.size(), "both branches of an if yield the same values");
  Op& added = append(OpCode::EndIf, Type::None, yields);
  std::vector<ValueId> results;
  for (size_t i = 0; i < types.size(); ++i) {
    RUNG_CHECK(typeOf(yields[i]) == types[i], "both branches of an if yield the same types");
    results.push_back(newResult(added, types[i]));
  }
  return results;
}

std::vector<ValueId> RungBuilder::loop(uint32_t count, std::span<const ValueId> carried) {
  Op& added = append(OpCode::Loop, Type::None, carried);
  added.count = count;
  std::vector<Type> types;
  for (ValueId id : carried) types.push_back(typeOf(id));
  std::vector<ValueId> results{newResult(added, Type::I32)};
  for (Type type : types) results.push_back(newResult(added, type));
  yieldTypes_.push_back(std::move(types));
  return results;
}

std::vector<ValueId> RungBuilder::endLoop(std::span<const ValueId> next) {
  RUNG_CHECK(!yieldTypes_.empty() && yieldTypes_.back().size() == next.size(),
             "a loop carries on the values it began with");
  const std::vector<Type> types = std::move(yieldTypes_.back());
  yieldTypes_.pop_back();
  Op& added = append(OpCode::EndLoop, Type::None, next);
  std::vector<ValueId> results;
  for (size_t i = 0; i < types.size(); ++i) {
    RUNG_CHECK(typeOf(next[i]) == types[i], "a carried value keeps its type");
    results.push_back(newResult(added, types[i]));
  }
  return results;
}

void RungBuilder::message(uint32_t op, ValueId number, ValueId channel, ValueId index, ValueId value) {
  const ValueId args[] = {number, channel, index, value};
  append(OpCode::Message, Type::None, args).ref = op;
}

ValueId RungBuilder::serviceRequest(ServiceId service, std::span<const ValueId> args) {
  RUNG_CHECK(args.size() <= RUNG_MAX_SERVICE_ARGS, "too many arguments of a service");
  Op& added = append(OpCode::ServiceRequest, Type::None, args);
  added.ref = service.index;
  return newResult(added, Type::I32);
}

ValueId RungBuilder::servicePoll(ValueId ticket) {
  return newResult(append(OpCode::ServicePoll, Type::None, {&ticket, 1}), Type::I32);
}

ValueId RungBuilder::serviceResult(ValueId ticket, uint32_t index) {
  Op& added = append(OpCode::ServiceResult, Type::None, {&ticket, 1});
  added.imm = index;
  return newResult(added, Type::I64);
}

void RungBuilder::trap(ValueId cond, FaultId fault) { append(OpCode::Trap, Type::None, {&cond, 1}).ref = fault.index; }

void RungBuilder::note(std::string_view text) {
  append(OpCode::Note, Type::None, {}).ref = static_cast<uint32_t>(rung_.notes.size());
  rung_.notes.emplace_back(text);
}

void RungBuilder::gotoRung(uint32_t target, ValueId cond) {
  rung_.transfer = {.kind = TransferKind::Goto, .cond = cond, .target = target};
}
void RungBuilder::call(RoutineId callee, ValueId cond) {
  rung_.transfer = {.kind = TransferKind::Call, .cond = cond, .callee = callee};
}
void RungBuilder::ret(ValueId cond) { rung_.transfer = {.kind = TransferKind::Ret, .cond = cond}; }
void RungBuilder::end(ValueId cond) { rung_.transfer = {.kind = TransferKind::End, .cond = cond}; }
void RungBuilder::switchTo(ValueId value, std::vector<uint32_t> targets) {
  rung_.transfer = {.kind = TransferKind::Switch, .value = value, .targets = std::move(targets)};
}

} // namespace rung::ir
