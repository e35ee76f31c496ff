// Decides for every byte of every space whether it is packed or expanded (the rule is in memory_layout.h).
#pragma once
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

// Per space and logical byte: enum rung_repr.
using Representation = std::vector<std::vector<uint8_t>>;

// `expandBits` false: everything is packed.
Representation chooseRepresentation(const Module& module, bool expandBits);

} // namespace rung::ir
