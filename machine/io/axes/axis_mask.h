// Axes of a control are numbered from 1. A mask has a bit an axis: axis n is bit n - 1.
#pragma once
#include <cstdint>

#include "rtlib/nc/technol/configuration.h"

namespace rung::io {

using nc::kMaxAxes;

using AxisMask = uint16_t;

constexpr bool has(AxisMask mask, uint32_t index) { return (mask >> index & 1) != 0; }
constexpr AxisMask bitOf(uint32_t index) { return static_cast<AxisMask>(1u << index); }
constexpr void clearBit(AxisMask& mask, uint32_t index) { mask = static_cast<AxisMask>(mask & ~bitOf(index)); }
constexpr void setBit(AxisMask& mask, uint32_t index) { mask = static_cast<AxisMask>(mask | bitOf(index)); }

} // namespace rung::io
