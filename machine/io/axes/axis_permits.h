// What allows axes to move: cells of the program, as masks. What is not said otherwise is as after MODULE_INIT.
#pragma once
#include "machine/io/axes/axis_mask.h"

namespace rung::io {

struct AxisPermits {
  AxisMask enabled = 0xFFFF;              // MPxPI l.6177
  AxisMask limitPlus = 0, limitMinus = 0; // KHx0, KHx1 l.6674
};

// What keeps an axis from moving in a direction.
enum class Hold : uint8_t { None, Disabled, Limit };

constexpr bool atLimit(const AxisPermits& in, uint32_t index, bool negative) {
  return has(negative ? in.limitMinus : in.limitPlus, index);
}
constexpr Hold holdOf(const AxisPermits& in, uint32_t index, bool negative, AxisMask enabled) {
  if (atLimit(in, index, negative)) return Hold::Limit;
  return has(enabled, index) ? Hold::None : Hold::Disabled;
}

} // namespace rung::io
