// Instructions that send a request to a device of the control (man. ch. 9, 11-13, 17-19, 23, 26): those that continue
// at once, and those of the EX kind, which are executed in every run of their mechanism until they are answered
// (inventory 11.3).
#include <vector>

#include "frontend/dialects/technol/lower/device_target.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

bool isRead(const OperandInfo& info) { return info.access != Access::Write; }
bool isWritten(const OperandInfo& info) { return info.access != Access::Read; }

// The operands of a statement and their descriptions in its row.
struct Given {
  std::span<const OperandInfo> infos;
  std::span<const Operand> operands;
  std::vector<DeviceTarget> targets; // for operands that are written
};

// Number of bytes to transfer. If `guard` is 1 and the length exceeds the rest of the data, the program stops with a
// fault.
ValueId lengthOf(Lowering& l, const Given& given, const DeviceTarget& data, ValueId guard) {
  const Operand* length = lengthIn(given.infos, given.operands);
  if (length == nullptr) return data.room();
  const ValueId count = l.b().zextOrTrunc(Type::I32, l.memory.value(*length, guard));
  if (!length->isConstant()) {
    const ValueId beyond = l.b().ltU(data.roomWithEnd(), count);
    l.emitter.protect(guard.valid() ? l.b().and_(guard, beyond) : beyond);
  }
  return count;
}

void addArguments(Lowering& l, DeviceRequest& request, const Given& given, DataForm form, ValueId guard) {
  for (uint32_t i = 0; i < given.operands.size(); ++i) {
    const OperandInfo& info = given.infos[i];
    if (!isRead(info)) continue;
    if (!isMemory(info)) {
      request.addOperand(i, given.operands[i], guard);
      continue;
    }
    const DeviceTarget data(l, given.operands[i], guard);
    if (isWritten(info)) { // PLCT_COL_ID: the column number is stored where its name will be
      data.addWord(request);
      continue;
    }
    data.require(form, guard);
    const ValueId count = form == DataForm::Bytes ? lengthOf(l, given, data, guard) : data.room();
    data.addTo(request, form, count);
  }
}

// Stores the results of an answer in the operands.
void store(DeviceRequest& request, ValueId ticket, const Given& given, DataForm form) {
  for (uint32_t i = 0; i < given.operands.size(); ++i) {
    const OperandInfo& info = given.infos[i];
    if (!isWritten(info) || !given.operands[i].given()) continue;
    given.targets[i].take(request, ticket, info.name, isMemory(info) ? form : DataForm::Integer);
  }
}

// Prepares the operands. `guard`: whether they are used in this run; an invalid id: always.
Given givenTo(Lowering& l, std::span<const Operand> operands, DataForm form, ValueId guard) {
  Given given{.infos = l.statement().row->info.operands.all(), .operands = operands, .targets = {}};
  given.targets.resize(operands.size());
  for (uint32_t i = 0; i < operands.size(); ++i) {
    if (!isWritten(given.infos[i]) || !operands[i].given()) continue;
    DeviceTarget& target = given.targets[i] = DeviceTarget(l, operands[i], guard);
    if (isMemory(given.infos[i])) {
      target.require(form, guard);
      if (form == DataForm::Bytes) lengthOf(l, given, target, guard);
    }
    if (guard.valid()) target.keep(guard);
  }
  return given;
}

// For ECAT_COMMAND without Val and Len whose command is in a cell: the error code if the command asks for a state,
// which could not be stored (man. l.18231); otherwise 0. The command is the one of the run that sent the request.
ValueId codeWithoutPlace(Lowering& l, const Given& given, ValueId isNew) {
  ir::RungBuilder& b = l.b();
  const Operand* command = nullptr;
  for (size_t i = 0; i < given.operands.size(); ++i) {
    if (text::equalsIgnoringCase(given.infos[i].name, "Cmd")) command = &given.operands[i];
    if (isWritten(given.infos[i]) && given.operands[i].given()) return {};
  }
  if (command == nullptr || command->isConstant()) return {};
  const ir::SlotId slot = l.ownSlot(Type::Bit);
  b.when(isNew, [&] {
    const ValueId asked = b.zextOrTrunc(Type::I32, l.memory.value(*command, isNew));
    b.slotStore(slot, b.or_(b.eq(asked, b.i32(nc::technol::kMasterStateCommand)),
                            b.eq(asked, b.i32(nc::technol::kSlaveStateCommand))));
  });
  return b.select(b.slotLoad(slot), b.constant(Type::I64, nc::technol::kNoPlaceCode), b.constant(Type::I64, 0));
}

// The unit continues at this instruction until it is answered.
void continueHere(Lowering& l) {
  Sequence& s = l.sequences.current();
  const uint32_t here = l.sequences.newState(s);
  l.sequences.storeState(s, l.b().i32(here));
  l.emitter.out().bind(s.states[here]);
}

} // namespace

// RLO and DR are set according to the row's effects.
void lowerService(Lowering& l, std::span<const Operand> o, int form) {
  const uint16_t effects = l.statement().row->effects;
  const auto data = static_cast<DataForm>(form);
  DeviceRequest request(l);
  addArguments(l, request, givenTo(l, o, data, {}), data, {});
  request.send();
  if (effects & kSetsRlo) l.r().setRlo(request.flag("RLO"));
  if (effects & kSetsDr) l.r().setDr(request.result("DR"));
}

// PLCT_*, ECAT_*: each instruction has one request at a time, which is answered in the next run at the earliest.
// Operands are read when the request is sent; results are stored in the places that they named then.
void lowerPolled(Lowering& l, std::span<const Operand> o, int form) {
  continueHere(l);
  ir::RungBuilder& b = l.b();
  const ir::SlotId slot = l.ownSlot(Type::I32);
  l.sequences.current().tickets.push_back(slot);
  const ValueId pending = b.slotLoad(slot);
  const ValueId isNew = b.eq(pending, b.i32(0));
  const auto data = static_cast<DataForm>(form);
  const Given given = givenTo(l, o, data, isNew);
  DeviceRequest request(l);
  addArguments(l, request, given, data, isNew);
  const ValueId ticket = b.choose(isNew, [&] { return request.send(); }, [&] { return pending; });
  const ValueId withoutPlace = codeWithoutPlace(l, given, isNew);
  request.use(ticket);
  const ValueId answered = b.and_(b.not_(isNew), request.answered());
  const ValueId none = b.constant(Type::I64, 0);
  const auto answer = [&] {
    const ValueId code = request.result("DR");
    return withoutPlace.valid() ? b.select(b.eq(code, none), withoutPlace, code) : code;
  };
  const ValueId code = b.choose(answered, answer, [&] { return none; });
  b.when(b.and_(answered, b.eq(code, none)), [&] { store(request, ticket, given, data); });
  b.slotStore(slot, b.select(b.or_(answered, request.forgotten()), b.i32(0), ticket));
  l.r().setRlo(answered);
  l.r().setDr(code);
}

// SA_READ, SA_WRITE: complete in the same run unless the area is locked; then the request is repeated (man.
// l.15547-15561).
void lowerShared(Lowering& l, std::span<const Operand> o, int form) {
  continueHere(l);
  const auto data = static_cast<DataForm>(form);
  const Given given = givenTo(l, o, data, {});
  DeviceRequest request(l);
  addArguments(l, request, given, data, {});
  const ValueId ticket = request.send();
  const ValueId done = request.flag("RLO"), code = request.result("DR");
  l.b().when(done, [&] { store(request, ticket, given, data); });
  l.r().setRlo(done);
  l.r().setDr(code);
}

} // namespace rung::frontend::technol
