// What the cells of axes report of their motions and positions; only axes that exist have any.
#pragma once
#include <array>
#include <cmath>

#include "machine/io/axes/axis_mask.h"

namespace rung::io {

struct AxisReport {
  AxisMask motion = 0;                           // PO_OSxPI
  AxisMask negative = 0;                         // SM_POxPI
  std::array<int64_t, kMaxAxes> positionEx = {}; // B_POL_EX, POSITION_POSk_EX (k < 6): 1/65536 µm
  std::array<int32_t, 6> positionShort = {};     // B_POL: 1/8 µm

  // Axis `index` + 1 is there, in mm (degrees).
  void place(uint32_t index, double position) {
    positionEx[index] = std::llround(position * 1000 * 65536);
    if (index < positionShort.size())
      positionShort[index] = static_cast<int32_t>(std::llround(position * 8000)); // wraps as the cell does
  }
};

} // namespace rung::io
