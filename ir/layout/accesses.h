// Which bytes of the memory block tasks read and chunks write, of spaces.
#pragma once
#include <vector>

#include "ir/layout/layout.h"

namespace rung::ir {

// All that chunks may write: ascending, none overlaps the next.
std::vector<rung_written> writtenBits(const Layout& layout);

// What a run of the task may read, its `begin` copies included: ascending, none touches the next.
std::vector<rung_span> readBytes(const Layout& layout, TaskId task);

} // namespace rung::ir
