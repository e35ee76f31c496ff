// A chunk as both emitters write it.
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
  std::vector<bool> isTarget; // a jump in the chunk leads to it; all of them are above it

  bool addsWeight = false; // some path costs extra weight, which the chunk adds up and reports where it is left
  // The host may read memory while the chunk runs. Elsewhere the chunk alone reaches the memory block, and emitters say
  // so to their compilers.
  bool hostReads = false;

  uint32_t endRung() const { return chunk.firstRung + chunk.rungCount; }
  const ir::Exit& exit(uint32_t rung) const { return exits[rung - chunk.firstRung]; }
};

// The layout outlives the plan.
ChunkPlan planOf(const ir::Layout& layout, uint32_t chunk);

} // namespace rung::codegen
