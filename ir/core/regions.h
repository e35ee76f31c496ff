// Which operations open and close the regions of a rung, for passes, interpreter and emitters.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

// For the operation that opens, divides or closes a region: the one that ends it (if: its else or endif; else: its
// endif; loop: its endloop) and the one that opened it (else, endif: the if; endloop: the loop). Its own index if there
// is none.
struct Region {
  uint32_t end;
  uint32_t begin;
};
// By operation; entries of operations that do not belong to a region are undefined. False if the rung has no regions.
bool findRegions(const Rung& rung, std::vector<Region>& regions);

// Compilers take a time that grows with the square of the length of a chain of operations: LLVM took 25 s for a line of
// 10,000 contacts. A long rung is therefore divided into stretches: the result of a chain passes from one stretch to
// the next through memory, which ends the chain for the compiler; everything else is computed in each stretch.

inline constexpr size_t kStretch = 256; // length in operations

inline bool isLong(const Rung& rung) { return rung.ops.size() >= 16 * kStretch; }

// By value, whether it passes through memory. Empty: none does, as in all rungs of normal length.
std::vector<bool> valuesThroughMemory(const Rung& rung);

} // namespace rung::ir
