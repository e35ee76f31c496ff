// The bytes of the memory block, in spaces, that tasks read and chunks write.
#pragma once
#include <vector>

#include "ir/shape/memory_layout.h"
#include "ir/shape/partition.h"

namespace rung::ir {

// Everything that chunks may write: ascending, without overlaps.
std::vector<rung_written> writtenBits(const MemoryLayout& layout);

// Everything that a run of the task may read, including its `begin` copies: ascending, no two adjacent.
std::vector<rung_span> readBytes(const MemoryLayout& layout, TaskId task);

// For a task that runs more than once per scan: offsets of groups of eight bytes of the memory block, ascending, that
// contain everything that a run may change, except its copies. Empty for other tasks; for a run with other effects
// (host calls, measuring); and if there are more than RUNG_MOST_CHANGES.
std::vector<uint32_t> changedWords(const MemoryLayout& layout, TaskId task);

} // namespace rung::ir
