// Which operations open and close the regions of a rung: for passes, interpreter and emitters, none of which looks for
// them itself.
#pragma once
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

} // namespace rung::ir
