// See code_unit_numbers.h.
#include "codegen/llvm/code_unit_numbers.h"

#include <fmt/format.h>

#include "ir/core/ops.h"

namespace rung::codegen {

using namespace ir;

CodeUnitNumbers::CodeUnitNumbers(const Partition& partition, const ModulePart& unit) {
  for (uint32_t i = 0; i < unit.chunkCount; ++i) {
    const Chunk& chunk = partition.chunks()[unit.firstChunk + i];
    const Routine& routine = partition.module().at(chunk.routine);
    for (uint32_t r = chunk.firstRung; r < chunk.firstRung + chunk.rungCount; ++r) {
      addRung(routine.rungs[r], partition.rungNumber(chunk.routine, r));
      addExit(exitOf(partition, chunk.routine, r));
    }
  }
}

bool CodeUnitNumbers::namesRung(OpCode code) {
  return code == OpCode::Trap || code == OpCode::Message || code == OpCode::ProfEnter || code == OpCode::ProfLeave;
}

std::string CodeUnitNumbers::name(uint32_t index) { return fmt::format("rung_number_{}", index); }

void CodeUnitNumbers::addRung(const Rung& rung, uint32_t number) {
  for (const Op& op : rung.ops) {
    if (op.code == OpCode::Trap) add(Kind::Line, lineOf(rung, op));
    if (namesRung(op.code)) add(Kind::Rung, number);
  }
}

void CodeUnitNumbers::addExit(const Exit& exit) {
  const auto addDestination = [&](const Destination& to) {
    if (!to.inside() && to.chunk != RUNG_NONE) add(Kind::Chunk, to.chunk);
  };
  addDestination(exit.taken);
  addDestination(exit.otherwise);
  for (const Destination& to : exit.targets) addDestination(to);
}

void CodeUnitNumbers::add(Kind kind, uint32_t number) {
  if (indices_.try_emplace({kind, number}, static_cast<uint32_t>(values_.size())).second) values_.push_back(number);
}

} // namespace rung::codegen
