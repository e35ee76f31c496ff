// The pieces that a program is compiled in.
#pragma once
#include <span>
#include <vector>

#include "codegen/llvm/module_part.h"
#include "ir/layout/layout.h"

namespace rung::codegen {

// Each of chunks that follow one another. `chunks`: ascending.
std::vector<ModulePart> cutPieces(const ir::Layout& layout, std::span<const uint32_t> chunks);

} // namespace rung::codegen
