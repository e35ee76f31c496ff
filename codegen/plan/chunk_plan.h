// A chunk in the form that both emitters write.
#pragma once
#include <cstdint>
#include <vector>

#include "ir/shape/layout.h"

namespace rung::codegen {

struct ChunkPlan {
  const ir::Chunk& chunk;
  const ir::Routine& routine;
  // By rung of the chunk.
  std::vector<ir::Exit> exits;
  std::vector<bool> isTarget; // target of a jump in the chunk; all such jumps are forward

  bool addsWeight = false; // some path costs extra weight, which the chunk accumulates and reports at its exits
  // The host may read memory while the chunk runs. Otherwise only the chunk accesses the memory block, and emitters
  // declare that to their compilers.
  bool hostReads = false;

  uint32_t endRung() const { return chunk.firstRung + chunk.rungCount; }
  const ir::Exit& exit(uint32_t rung) const { return exits[rung - chunk.firstRung]; }
};

// The layout must outlive the plan.
ChunkPlan planOf(const ir::Layout& layout, uint32_t chunk);

} // namespace rung::codegen
