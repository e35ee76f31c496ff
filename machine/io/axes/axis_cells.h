// Cells of axes that simulated and real ones have alike (inventory of the services, 1.6, 15.1): what lets them move,
// the position loop, requests for motions and places.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "machine/io/axes/axis_permits.h"
#include "machine/io/axes/axis_report.h"
#include "rtlib/core/memory.h"

namespace rung::io {

// The names that a bit of each axis has: `#` in the pattern is X, Y, Z and the numbers from 4 on, `%` the number.
std::string nameOfAxis(std::string_view pattern, uint32_t axis);

// The places of such bits.
class AxisBits {
public:
  AxisBits() = default; // a program that has nothing
  AxisBits(const rung_program& program, std::string_view pattern);
  AxisMask read(const core::Memory& memory) const;
  bool read(const core::Memory& memory, uint32_t axis) const { return memory.read(places_[axis - 1]) != 0; }
  // Those of the axes in `which`.
  void write(const core::Memory& memory, AxisMask which, AxisMask mask) const;

private:
  std::array<core::Place, kMaxAxes> places_;
};

class AxisCells {
public:
  AxisCells() = default; // a program that has nothing
  explicit AxisCells(const rung_program& program);

  void read(const core::Memory& memory, AxisPermits& permits) const;
  const AxisBits& loops() const { return loops_; }     // VAZBA_x: the position loop is closed (l.6306)
  const AxisBits& motions() const { return motions_; } // PO_OSxPI
  // Of the axes in `which`.
  void write(const core::Memory& memory, AxisMask which, const AxisReport& report) const;

private:
  AxisBits enabled_, limitPlus_, limitMinus_, loops_, motions_, directions_;
  std::array<core::Place, kMaxAxes> positionEx_, incrementEx_;
  std::array<core::Place, 6> positionShort_, incrementShort_;
  std::array<std::array<core::Place, kMaxAxes>, 5> positionOfSpaces_;
};

} // namespace rung::io
