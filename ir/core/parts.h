// Partitions a task's run into parts of nearly equal weight. A dialect does this before any pass, and asks how many
// parts it needs.
//
// Rungs that begin at one position of the source are one piece (the compiler adds rungs to some), and so are a
// routine's closing rung and the one above it. A call has the weight of everything that is called from there, each
// routine once: loops and conditions are not considered.
#pragma once
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

struct PartPiece {
  uint32_t firstRung = 0;
  uint64_t weight = 0;
};

// The pieces of a routine in order, never empty.
std::vector<PartPiece> partPieces(const Module& module, RoutineId routine);

// The first pieces of parts 2, 3, …: the weight of the longest part is minimal, and among such partitions each border
// is nearest to its share of the whole. Fewer borders than parts - 1 if there are fewer pieces.
std::vector<uint32_t> cutParts(const std::vector<PartPiece>& pieces, uint32_t parts);

// Partitions the run of `task` into `parts`: sets its `parts` and `borders`.
void cutTask(const Module& module, Task& task, uint32_t parts);

// The weight of the longest part of that partition.
uint64_t longestPart(const std::vector<PartPiece>& pieces, uint32_t parts);
// The smallest number of parts of which none has more weight than `most`; 0 if a single piece has.
uint32_t partsNeeded(const std::vector<PartPiece>& pieces, uint64_t most);

} // namespace rung::ir
