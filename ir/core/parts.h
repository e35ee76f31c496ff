// How a task's run is cut into parts of nearly equal weight. A dialect cuts here, before any pass, and asks how many
// parts it needs.
//
// Rungs that begin at one place of the source are one piece (the compiler adds rungs to some), and so are a routine's
// closing rung and the one above it. A call weighs what it calls, once, and all that is called from there: loops and
// conditions are not looked at.
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

// The first pieces of parts 2, 3, …: the longest part is as light as can be, and among such cuts each border lies
// nearest to its share of the whole. Fewer borders than parts - 1 when there are not so many pieces.
std::vector<uint32_t> cutParts(const std::vector<PartPiece>& pieces, uint32_t parts);

// Cuts the run of `task` into `parts`: its `parts` and `borders`.
void cutTask(const Module& module, Task& task, uint32_t parts);

// The weight of the longest part of that partition.
uint64_t longestPart(const std::vector<PartPiece>& pieces, uint32_t parts);
// The smallest number of parts of which none is heavier than `most`; 0 when one piece alone is.
uint32_t partsNeeded(const std::vector<PartPiece>& pieces, uint64_t most);

} // namespace rung::ir
