// Procedures (see procedures.h).
#include "frontend/dialects/technol/lower/procedures.h"

#include <algorithm>
#include <utility>

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

Procedures::Procedures(Memory& memory) : m_(memory), onMessage_(memory.program().procedureNamed(kOnMessage)) {
  for (const Procedure& procedure : memory.program().procedures)
    routines_.push_back(memory.newRoutine("PROC " + symbolKey(procedure.name)));
}

uint32_t Procedures::eventOf(uint32_t procedure) {
  const auto found = std::ranges::find(events_, procedure);
  if (found == events_.end()) return events_.push_back(procedure), static_cast<uint32_t>(events_.size()) - 1;
  return static_cast<uint32_t>(found - events_.begin());
}

void Procedures::call(uint32_t procedure, uint32_t depth, ValueId cond) {
  std::vector<ir::SlotId> kept;
  for (uint32_t level = 0; level < depth; ++level) {
    kept.push_back(m_.newSlot(Type::Bit, "CALL~" + std::to_string(m_.module().slots.size()), true));
    m_.b().slotStore(kept[level], m_.r().stack(level));
  }
  m_.out().call(routines_[procedure], cond);
  for (uint32_t level = 0; level < kept.size(); ++level) m_.r().setStack(level, m_.b().slotLoad(kept[level]));
}

void Procedures::saveRegisters() {
  if (saved_.empty())
    for (const auto& [type, key] : {std::pair(Type::Bit, "SAVED.RLO"), std::pair(Type::I64, "SAVED.DR"),
                                    std::pair(Type::F64, "SAVED.DR_REAL"), std::pair(Type::I32, "SAVED.BX")})
      saved_.push_back(m_.newSlot(type, key, true));
  Registers& r = m_.r();
  const ValueId values[] = {r.rlo(), r.dr(Type::I64), r.real(), r.bx()};
  for (size_t i = 0; i < saved_.size(); ++i) m_.b().slotStore(saved_[i], values[i]);
}

void Procedures::restoreRegisters() {
  ir::RungBuilder& b = m_.b();
  m_.r().setRlo(b.slotLoad(saved_[0]));
  m_.r().setReal(b.slotLoad(saved_[2]));
  m_.r().setDr(b.slotLoad(saved_[1]));
  m_.r().setBx(b.slotLoad(saved_[3]));
}

} // namespace rung::frontend::technol
