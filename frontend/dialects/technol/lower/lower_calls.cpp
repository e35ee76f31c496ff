// Procedures and the ends of start and shutdown (man. ch. 3.17, 5.3).
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"

namespace rung::frontend::technol {

using ir::ValueId;

void lowerCall(Lowering& l, std::span<const Operand> o, int) { l.callProcedure(o[0].index); }

// One bit a file: the host waits until all files that have the instruction have executed one (man. l.2571-2601).
void lowerFinished(Lowering& l, std::span<const Operand>, int cell) {
  const uint32_t file = l.statement().file;
  ir::Place at = place(static_cast<HostCell>(cell));
  at.byte += file / 8;
  at.bit = file % 8;
  l.b().store(at, l.b().bit(false));
}

} // namespace rung::frontend::technol
