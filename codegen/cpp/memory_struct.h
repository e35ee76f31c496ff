// C++ text of the struct through which a debugger shows the memory block by names (ir/shape/memory_members.h).
#pragma once
#include <string>

#include "ir/shape/memory_layout.h"

namespace rung::codegen {

// Writes `struct rung_memory`. It includes no header, so its names do not conflict with macros.
void writeMemoryStruct(const ir::MemoryLayout& layout, std::string& out);

} // namespace rung::codegen
