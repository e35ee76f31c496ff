// The places that a program's rungs use, as a person would list them.
#pragma once
#include <vector>

#include "ir/uses/uses.h"
#include "rung/program.h"

namespace rung::xref {

struct UsedPlace {
  ir::Use use; // one of them
  bool read = false;
  bool written = false;
};

// At fixed addresses, each once and in their order; what a latch holds counts as a use of what it was copied from.
std::vector<UsedPlace> usedPlaces(const rung_program& program, const ir::Uses& uses);

} // namespace rung::xref
