// Which bytes of the memory block tasks read and chunks write, of spaces.
#pragma once
#include <vector>

#include "ir/shape/memory_layout.h"
#include "ir/shape/partition.h"

namespace rung::ir {

// All that chunks may write: ascending, none overlaps the next.
std::vector<rung_written> writtenBits(const MemoryLayout& layout);

// What a run of the task may read, its `begin` copies included: ascending, none touches the next.
std::vector<rung_span> readBytes(const MemoryLayout& layout, TaskId task);

// Of a task that a scan runs more than once: offsets of eight bytes of the memory block, ascending, where all lies that
// a run may change, its copies apart. Empty for other tasks; where a run does more than that (it asks the host, it is
// measured); and where there are more than RUNG_MOST_CHANGES.
std::vector<uint32_t> changedWords(const MemoryLayout& layout, TaskId task);

} // namespace rung::ir
