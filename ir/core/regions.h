// Which operations open and close the regions of a rung: for passes, interpreter and emitters, none of which looks for
// them itself.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

// For the operation that opens, divides or closes a region: the one that ends it (if: its else or endif; else: its
// endif; loop: its endloop) and the one that opened it (else, endif: the if; endloop: the loop). Own index where there
// is none.
struct Region {
  uint32_t end;
  uint32_t begin;
};
// By operation; nothing is said of those that have to do with no region. False when there are no others.
bool findRegions(const Rung& rung, std::vector<Region>& regions);

// Compilers take a time that grows with the square of the length of a chain of operations: a line of 10,000 contacts
// took LLVM 25 s. A rung that long is dealt with in stretches: what a chain has computed goes through memory from one
// to the next, where it ends for whatever looks along it, and all else is computed in each stretch.

inline constexpr size_t kStretch = 256; // operations

inline bool isLong(const Rung& rung) { return rung.ops.size() >= 16 * kStretch; }

// By value, whether it goes through memory. Empty: none, as in all rungs of a usual length.
std::vector<bool> valuesThroughMemory(const Rung& rung);

} // namespace rung::ir
