// The struct that shows a debugger the memory block by names (ir/shape/memory_members.h), as C++ text.
#pragma once
#include <string>

#include "ir/shape/memory_layout.h"

namespace rung::codegen {

// `struct rung_memory`. It needs no header, so that the names meet no macros.
void writeMemoryStruct(const ir::MemoryLayout& layout, std::string& out);

} // namespace rung::codegen
