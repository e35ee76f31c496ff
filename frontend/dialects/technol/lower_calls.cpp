// Procedures, messages and the ends of start and shutdown (man. ch. 3.17, 14.3, 5.3).
#include "frontend/dialects/technol/lower.h"
#include "frontend/dialects/technol/lowering.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

void lowerCall(Lowering& l, std::span<const Operand> o, int) { l.callProcedure(o[0].index, o[0].range); }

void Lowering::saveRegisters() {
  if (saved_.empty())
    for (const auto& [type, key] : {std::pair(Type::Bit, "SAVED.RLO"), std::pair(Type::I64, "SAVED.DR"),
                                    std::pair(Type::F64, "SAVED.DR_REAL"), std::pair(Type::I32, "SAVED.BX")}) {
      module_.slots.push_back({.type = type, .transient = true, .key = key});
      saved_.push_back({static_cast<uint32_t>(module_.slots.size()) - 1});
    }
  const ValueId values[] = {r().rlo(), r().dr(Type::I64), r().real(), r().bx()};
  for (size_t i = 0; i < saved_.size(); ++i) b().slotStore(saved_[i], values[i]);
}

void Lowering::restoreRegisters() {
  r().setRlo(b().slotLoad(saved_[0]));
  r().setReal(b().slotLoad(saved_[2]));
  r().setDr(b().slotLoad(saved_[1]));
  r().setBx(b().slotLoad(saved_[3]));
}

namespace {

struct MessageParts {
  ValueId number, subId, par1;
};

void show(Lowering& l, const MessageParts& m, uint32_t op, bool persistent) {
  l.b().message(op, m.number, l.b().i32(persistent ? 1 : 0), m.subId, m.par1);
}

// `set` 1 shows and 0 removes a persistent message; without it the message is transient.
void showOrRemove(Lowering& l, const MessageParts& m, const Operand& set, ValueId setValue) {
  if (!set.given()) return show(l, m, RUNG_MESSAGE_SHOW_LOG, false);
  if (set.isConstant()) return show(l, m, set.value != 0 ? RUNG_MESSAGE_SHOW_LOG : RUNG_MESSAGE_CLEAR, true);
  l.b().if_(setValue);
  show(l, m, RUNG_MESSAGE_SHOW_LOG, true);
  l.b().else_();
  show(l, m, RUNG_MESSAGE_CLEAR, true);
  l.b().endIf();
}

} // namespace

// ESET [error],[subid],[set],[par1],[par2],[par3]; number in DR where it is not given (man. l.5086-5130). The second
// and third parameter lie in @ESET.PAR2, @ESET.PAR3 when the host gets the message.
void lowerMessage(Lowering& l, std::span<const Operand> o, int condition) {
  ir::RungBuilder& b = l.b();
  const auto wide = [&](const Operand& operand) {
    return operand.given() ? b.zextOrTrunc(Type::I64, l.value(operand)) : b.constant(Type::I64, 0);
  };
  MessageParts m;
  const ValueId number =
      o[0].given() ? b.zextOrTrunc(Type::I32, l.value(o[0])) : b.zextOrTrunc(Type::I32, l.r().dr(Type::I16));
  m.number = number;
  m.subId = o[1].given() ? b.zextOrTrunc(Type::I32, l.value(o[1])) : b.i32(0);
  m.par1 = wide(o[3]);
  const ValueId par2 = wide(o[4]), par3 = wide(o[5]);
  ValueId set;
  if (o[2].given() && !o[2].isConstant()) set = b.ne(wide(o[2]), b.constant(Type::I64, 0));
  const ValueId rlo = condition == kIfRlo ? l.r().rlo() : ValueId{};
  const bool calls = l.onMessage() != kNone && l.currentProcedure() != l.onMessage();
  if (calls) l.saveRegisters();
  if (rlo.valid()) b.if_(rlo);
  b.store(l.place(HostCell::MessagePar2), par2);
  b.store(l.place(HostCell::MessagePar3), par3);
  showOrRemove(l, m, o[2], set);
  if (rlo.valid()) b.endIf();
  if (!calls) return;
  l.r().setDr(b.sextOrTrunc(Type::I64, number));
  l.callProcedure(l.onMessage(), l.statement().range(), rlo);
  l.restoreRegisters();
}

// One bit a file: the host waits until all files that have the instruction have executed one (man. l.2571-2601).
void lowerFinished(Lowering& l, std::span<const Operand>, int cell) {
  const uint32_t file = l.statement().file;
  ir::Place place = l.place(static_cast<HostCell>(cell));
  place.byte += file / 8;
  place.bit = file % 8;
  l.b().store(place, l.b().bit(false));
}

} // namespace rung::frontend::technol
