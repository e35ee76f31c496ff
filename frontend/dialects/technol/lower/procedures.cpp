// Procedures.
#include "frontend/dialects/technol/lower/procedures.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

Procedures::Procedures(const SourceProgram& program, Emitter& emitter)
    : emitter_(emitter), onMessage_(program.procedureNamed(kOnMessage)) {
  for (const Procedure& procedure : program.procedures)
    routines_.push_back(emitter.newRoutine("PROC " + symbolKey(procedure.name)));
}

ValueId Procedures::event(uint32_t procedure) {
  const auto number = std::ranges::find(events_, procedure) - events_.begin();
  if (number == std::ssize(events_)) events_.push_back(procedure);
  return emitter_.routine(Type::I64, number, routines_[procedure]);
}

void Procedures::call(uint32_t procedure, uint32_t depth, ValueId cond) {
  std::vector<ir::SlotId> kept;
  for (uint32_t level = 0; level < depth; ++level) {
    kept.push_back(emitter_.newSlot(Type::Bit, "CALL~" + std::to_string(emitter_.module().slots.size()), true));
    emitter_.b().slotStore(kept[level], emitter_.r().stack(level));
  }
  emitter_.out().call(routines_[procedure], cond);
  for (uint32_t level = 0; level < kept.size(); ++level)
    emitter_.r().setStack(level, emitter_.b().slotLoad(kept[level]));
}

void Procedures::saveRegisters() {
  if (saved_.empty())
    for (const auto& [type, key] : {std::pair(Type::Bit, "SAVED.RLO"), std::pair(Type::I64, "SAVED.DR"),
                                    std::pair(Type::F64, "SAVED.DR_REAL"), std::pair(Type::I32, "SAVED.BX")})
      saved_.push_back(emitter_.newSlot(type, key, true));
  Registers& r = emitter_.r();
  const ValueId values[] = {r.rlo(), r.dr(Type::I64), r.real(), r.bx()};
  for (size_t i = 0; i < saved_.size(); ++i) emitter_.b().slotStore(saved_[i], values[i]);
}

void Procedures::restoreRegisters() {
  ir::RungBuilder& b = emitter_.b();
  emitter_.r().setRlo(b.slotLoad(saved_[0]));
  emitter_.r().setReal(b.slotLoad(saved_[2]));
  emitter_.r().setDr(b.slotLoad(saved_[1]));
  emitter_.r().setBx(b.slotLoad(saved_[3]));
}

// Procedures, and the ends of start-up and shutdown (man. ch. 3.17, 5.3).

using ir::ValueId;

void lowerCall(Lowering& l, std::span<const Operand> o, int) { l.callProcedure(o[0].index); }

// Each file has one bit: the host waits until every file that has the instruction has executed it (man. l.2571-2601).
void lowerFinished(Lowering& l, std::span<const Operand>, int cell) {
  const uint32_t file = l.statement().file;
  ir::Place at = place(static_cast<HostCell>(cell));
  at.byte += file / 8;
  at.bit = file % 8;
  l.b().store(at, l.b().bit(false));
}

} // namespace rung::frontend::technol
