// The slot of the PMC family's controls.
#pragma once
#include <cstdint>

namespace rung::nc::pmc {

// In every slot level 1 runs, followed by one part of level 2 (P3).
inline constexpr uint32_t kSlotUs = 8000;

} // namespace rung::nc::pmc
