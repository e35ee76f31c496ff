// See piece_numbers.h.
#include "codegen/llvm/piece_numbers.h"

#include <fmt/format.h>

#include "ir/core/ops.h"

namespace rung::codegen {

using namespace ir;

PieceNumbers::PieceNumbers(const Cut& cut, const ModulePart& piece) {
  for (uint32_t i = 0; i < piece.chunkCount; ++i) {
    const Chunk& chunk = cut.chunks()[piece.firstChunk + i];
    const Routine& routine = cut.module().at(chunk.routine);
    for (uint32_t r = chunk.firstRung; r < chunk.firstRung + chunk.rungCount; ++r) {
      addRung(routine.rungs[r], cut.rungNumber(chunk.routine, r));
      addExit(exitOf(cut, chunk.routine, r));
    }
  }
}

bool PieceNumbers::namesRung(OpCode code) {
  return code == OpCode::Trap || code == OpCode::Message || code == OpCode::ProfEnter || code == OpCode::ProfLeave;
}

std::string PieceNumbers::name(uint32_t index) { return fmt::format("rung_number_{}", index); }

void PieceNumbers::addRung(const Rung& rung, uint32_t number) {
  for (const Op& op : rung.ops) {
    if (op.code == OpCode::Trap) add(Kind::Line, lineOf(rung, op));
    if (namesRung(op.code)) add(Kind::Rung, number);
  }
}

void PieceNumbers::addExit(const Exit& exit) {
  const auto addDestination = [&](const Destination& to) {
    if (!to.inside() && to.chunk != RUNG_NONE) add(Kind::Chunk, to.chunk);
  };
  addDestination(exit.taken);
  addDestination(exit.otherwise);
  for (const Destination& to : exit.targets) addDestination(to);
}

void PieceNumbers::add(Kind kind, uint32_t number) {
  if (indices_.try_emplace({kind, number}, static_cast<uint32_t>(values_.size())).second) values_.push_back(number);
}

} // namespace rung::codegen
