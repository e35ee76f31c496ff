// Procedures and the ends of start and shutdown (man. ch. 3.17, 5.3).
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

void lowerCall(Lowering& l, std::span<const Operand> o, int) { l.callProcedure(o[0].index); }

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

// One bit a file: the host waits until all files that have the instruction have executed one (man. l.2571-2601).
void lowerFinished(Lowering& l, std::span<const Operand>, int cell) {
  const uint32_t file = l.statement().file;
  ir::Place place = l.place(static_cast<HostCell>(cell));
  place.byte += file / 8;
  place.bit = file % 8;
  l.b().store(place, l.b().bit(false));
}

} // namespace rung::frontend::technol
