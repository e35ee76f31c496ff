// The meaning of each operation (see rung_run.h).
#include "ir/interp/rung_run.h"

#include <algorithm>

#include "ir/core/eval.h"
#include "ir/core/ops.h"
#include "ir/support/check.h"
#include "rtlib/core/ticks.h"

namespace rung::ir {
namespace {

constexpr size_t kFaulted = SIZE_MAX;

// Whether the operation counts as work: see Counting::Operations.
bool isWork(OpCode code) {
  return code != OpCode::Const && code != OpCode::Note && code != OpCode::Else && code != OpCode::EndIf &&
         code != OpCode::ProfEnter && code != OpCode::ProfLeave;
}

} // namespace

bool RungRun::run() {
  size_t i = 0;
  while (i < rung_.ops.size()) {
    operations_ += isWork(rung_.ops[i].code) ? 1 : 0;
    i = step(rung_.ops[i], i);
    if (i == kFaulted) return false;
  }
  return true;
}

// ---- memory --------------------------------------------------------------------------------------------------------

uint64_t RungRun::readBytes(uint32_t offset, Type type) const {
  uint64_t value = 0;
  for (uint32_t i = 0; i < byteWidth(type); ++i) value |= static_cast<uint64_t>(mem_[offset + i]) << (8 * i);
  return value;
}

void RungRun::writeBytes(uint32_t offset, Type type, uint64_t value) {
  for (uint32_t i = 0; i < byteWidth(type); ++i) mem_[offset + i] = static_cast<uint8_t>(value >> (8 * i));
}

uint64_t RungRun::readBit(BitLocation at) const {
  if (!at.wholeByte) return (mem_[at.offset] >> at.bit) & 1;
  RUNG_CHECK(mem_[at.offset] <= 1, "the byte of a bit holds 0 or 1");
  return mem_[at.offset];
}

void RungRun::writeBit(BitLocation at, bool value) {
  const auto mask = static_cast<uint8_t>(1u << at.bit);
  if (at.wholeByte)
    mem_[at.offset] = value ? 1 : 0;
  else
    mem_[at.offset] = static_cast<uint8_t>(value ? mem_[at.offset] | mask : mem_[at.offset] & ~mask);
}

void RungRun::tell(const Op& op, const BitRange& place, SlotId slot, uint64_t value, bool writes) const {
  if (observer_ == nullptr) return;
  observer_->accessed({.rung = number_,
                       .operation = static_cast<uint32_t>(&op - rung_.ops.data()),
                       .place = place,
                       .slot = slot,
                       .value = value,
                       .writes = writes});
}

void RungRun::tellMemory(const Op& op, uint64_t bit, uint64_t value, bool writes) const {
  tell(op, {SpaceId{op.ref}, static_cast<uint32_t>(bit), bitWidth(op.type)}, {}, value, writes);
}

void RungRun::load(const Op& op) {
  const auto place = static_cast<uint64_t>(op.imm);
  const SpaceId space{op.ref};
  give(op, op.type == Type::Bit ? readBit(layout_.bit(space, place))
                                : readBytes(layout_.byte(space, static_cast<uint32_t>(place / 8)), op.type));
  tellMemory(op, place, values_[op.result.index], false);
}

void RungRun::store(const Op& op) {
  const auto place = static_cast<uint64_t>(op.imm);
  const SpaceId space{op.ref};
  if (op.type == Type::Bit)
    writeBit(layout_.bit(space, place), in(op, 0) != 0);
  else
    writeBytes(layout_.byte(space, static_cast<uint32_t>(place / 8)), op.type, in(op, 0));
  tellMemory(op, place, in(op, 0), true);
}

void RungRun::loadAt(const Op& op) {
  const auto index = static_cast<uint32_t>(in(op, 0));
  if (index >= op.count) return give(op, 0);
  const auto byte = static_cast<uint32_t>(op.imm / 8) + index * unitBytes(op);
  give(op, readBytes(layout_.byte(SpaceId{op.ref}, byte), op.type));
  tellMemory(op, uint64_t{byte} * 8, values_[op.result.index], false);
}

void RungRun::storeAt(const Op& op) {
  const auto index = static_cast<uint32_t>(in(op, 0));
  if (index >= op.count) return;
  const auto byte = static_cast<uint32_t>(op.imm / 8) + index * unitBytes(op);
  writeBytes(layout_.byte(SpaceId{op.ref}, byte), op.type, in(op, 1));
  tellMemory(op, uint64_t{byte} * 8, in(op, 1), true);
}

void RungRun::loadBitAt(const Op& op) {
  const auto index = static_cast<uint32_t>(in(op, 0));
  const auto bit = static_cast<uint32_t>(in(op, 1));
  const uint32_t unitBits = unitBytes(op) * 8;
  if (index >= op.count || bit >= unitBits) return give(op, 0);
  const uint64_t place = static_cast<uint64_t>(op.imm) + uint64_t{index} * unitBits + bit;
  give(op, readBit(layout_.bit(SpaceId{op.ref}, place)));
  tellMemory(op, place, values_[op.result.index], false);
}

void RungRun::storeBitAt(const Op& op) {
  const auto index = static_cast<uint32_t>(in(op, 0));
  const auto bit = static_cast<uint32_t>(in(op, 1));
  const uint32_t unitBits = unitBytes(op) * 8;
  if (index >= op.count || bit >= unitBits) return;
  const uint64_t place = static_cast<uint64_t>(op.imm) + uint64_t{index} * unitBits + bit;
  writeBit(layout_.bit(SpaceId{op.ref}, place), in(op, 2) != 0);
  tellMemory(op, place, in(op, 2), true);
}

void RungRun::slotLoad(const Op& op) {
  give(op, op.type == Type::Bit ? readBit({slotOffset(op), 0, true}) : readBytes(slotOffset(op), op.type));
  tell(op, {}, SlotId{op.ref}, values_[op.result.index], false);
}

void RungRun::slotStore(const Op& op) {
  if (op.type == Type::Bit)
    writeBit({slotOffset(op), 0, true}, in(op, 0) != 0);
  else
    writeBytes(slotOffset(op), op.type, in(op, 0));
  tell(op, {}, SlotId{op.ref}, in(op, 0), true);
}

// ---- regions -------------------------------------------------------------------------------------------------------

// The operands of `from` become the results of `to`, after the first `skip`. Results may also be operands, if carried
// values are permuted, so all are read first.
void RungRun::giveArgs(const Op& from, const Op& to, uint32_t skip) {
  for (int i = 0; i < from.argCount; ++i) carried_[static_cast<size_t>(i)] = in(from, i);
  std::copy_n(carried_.begin(), from.argCount, values_.begin() + to.result.index + skip);
}

size_t RungRun::endLoop(const Op& op, size_t index) {
  const size_t begin = regions_[index].begin;
  const Op& loop = rung_.ops[begin];
  const uint64_t pass = values_[loop.result.index] + 1;
  if (pass < loop.count) {
    giveArgs(op, loop, 1);
    give(loop, pass);
    return begin + 1;
  }
  giveArgs(op, op, 0);
  return index + 1;
}

// ---- host ----------------------------------------------------------------------------------------------------------

void RungRun::message(const Op& op) {
  rung_message message{};
  message.op = op.ref;
  message.number = static_cast<uint32_t>(in(op, 0));
  message.channel = static_cast<int32_t>(in(op, 1));
  message.index = static_cast<int32_t>(in(op, 2));
  message.value = static_cast<int64_t>(in(op, 3));
  message.real = typeOf(rung_, arg(rung_, op, 3)) == Type::F64 ? 1 : 0;
  message.rung = number_;
  ctx_.host->message(&ctx_, &message);
}

void RungRun::request(const Op& op) {
  int64_t args[RUNG_MAX_SERVICE_ARGS] = {};
  for (int i = 0; i < op.argCount; ++i) args[i] = static_cast<int64_t>(in(op, i));
  give(op, ctx_.host->service_request(&ctx_, op.ref, args, op.argCount));
}

void RungRun::setFault(const Op& op) {
  ctx_.fault.code = op.ref;
  ctx_.fault.rung = number_;
  ctx_.fault.line = lineOf(rung_, op);
}

uint64_t RungRun::clock() const { return counting_ == Counting::Operations ? operations_ : core::readTicks(); }

void RungRun::countRung() {
  rung_prof& prof = ctx_.prof[number_];
  if (rung_.transfer.kind != TransferKind::Next) ++operations_;
  const uint64_t time = clock() - prof.started;
  prof.count += 1;
  prof.total += time;
  prof.max = std::max<uint64_t>(prof.max, time);
}

void RungRun::evaluate(const Op& op) {
  uint64_t args[4] = {};
  for (int i = 0; i < op.argCount; ++i) args[i] = in(op, i);
  give(op, evalPure(op.code, op.type, typeOf(rung_, arg(rung_, op, 0)), args));
}

size_t RungRun::beginIf(const Op& op, size_t index) {
  if (in(op, 0) != 0) return index + 1;
  const size_t end = regions_[index].end;
  return rung_.ops[end].code == OpCode::Else ? end + 1 : end;
}

size_t RungRun::beginLoop(const Op& op, size_t index) {
  if (op.count == 0) {
    giveArgs(op, rung_.ops[regions_[index].end], 0);
    return regions_[index].end + 1;
  }
  giveArgs(op, op, 1);
  give(op, 0);
  return index + 1;
}

// Returns the index of the next operation.
// NOLINTNEXTLINE(readability-function-size): a case for every operation
size_t RungRun::step(const Op& op, size_t index) {
  switch (op.code) {
  case OpCode::Const:
    give(op, static_cast<uint64_t>(op.imm));
    break;
// All operations without effects are evaluated by one function.
#define RUNG_OP(...)
#define RUNG_VALUE_OP(code, ...) case OpCode::code:
#include "ir/core/ops.def"
    evaluate(op);
    break;
  case OpCode::Load: load(op); break;
  case OpCode::Store: store(op); break;
  case OpCode::LoadAt: loadAt(op); break;
  case OpCode::StoreAt: storeAt(op); break;
  case OpCode::LoadBitAt: loadBitAt(op); break;
  case OpCode::StoreBitAt: storeBitAt(op); break;
  case OpCode::SlotLoad: slotLoad(op); break;
  case OpCode::SlotStore: slotStore(op); break;
  case OpCode::Now: give(op, static_cast<uint64_t>(ctx_.now_us)); break;
  case OpCode::If: return beginIf(op, index);
  // After the branch above an else has run, its yields become the results of the endif.
  case OpCode::Else: giveArgs(op, rung_.ops[regions_[index].end], 0); return regions_[index].end + 1;
  case OpCode::EndIf: giveArgs(op, op, 0); break;
  case OpCode::Loop: return beginLoop(op, index);
  case OpCode::EndLoop: return endLoop(op, index);
  case OpCode::Message: message(op); break;
  case OpCode::ServiceRequest: request(op); break;
  case OpCode::ServicePoll: give(op, ctx_.host->service_poll(&ctx_, static_cast<uint32_t>(in(op, 0)))); break;
  case OpCode::ServiceResult:
    give(op, static_cast<uint64_t>(
                 ctx_.host->service_result(&ctx_, static_cast<uint32_t>(in(op, 0)), static_cast<uint32_t>(op.imm))));
    break;
  case OpCode::Trap:
    if (in(op, 0) == 0) break;
    setFault(op);
    return kFaulted;
  case OpCode::Note: break;
  case OpCode::ProfEnter: ctx_.prof[number_].started = clock(); break;
  case OpCode::ProfLeave: countRung(); break;
  }
  return index + 1;
}

} // namespace rung::ir
