// Which operations of a rung a run has reached.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ir/core/module.h"

namespace rung::report {

// A condition of a region around an operation, and the value that it must have for the operation to be reached.
struct Guard {
  uint32_t value = 0; // of the rung
  bool wanted = true;
};

// By value of the rung: the guards of the operation that computes it, from the outside in.
std::vector<std::vector<Guard>> guardsOf(const ir::Rung& rung);

// `values` are those of a run.
bool reached(std::span<const Guard> guards, std::span<const uint64_t> values);

} // namespace rung::report
