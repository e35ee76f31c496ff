// Cells of axes that simulated and real ones have alike (inventory of the services, 1.6, 15.1): what lets them move,
// the position loop, requests for motions and places.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "rtlib/core/memory.h"
#include "tools/devices/axes/axis_permits.h"
#include "tools/devices/axes/axis_report.h"

namespace rung::device_requests {

// The names that a bit of each axis has: `#` in the pattern is X, Y, Z and the numbers from 4 on, `%` the number.
std::string nameOfAxis(std::string_view pattern, uint32_t axis);

// The places of such bits.
class AxisBits {
public:
  AxisBits() = default; // a program that has nothing
  AxisBits(const rung_program& program, std::string_view pattern);
  devices::AxisMask read(const rt::Memory& memory) const;
  bool read(const rt::Memory& memory, uint32_t axis) const { return memory.read(places_[axis - 1]) != 0; }
  // Those of the axes in `which`.
  void write(const rt::Memory& memory, devices::AxisMask which, devices::AxisMask mask) const;

private:
  std::array<rt::Place, devices::kMaxAxes> places_;
};

class AxisCells {
public:
  AxisCells() = default; // a program that has nothing
  explicit AxisCells(const rung_program& program);

  void read(const rt::Memory& memory, devices::AxisPermits& permits) const;
  const AxisBits& loops() const { return loops_; }     // VAZBA_x: the position loop is closed (l.6306)
  const AxisBits& motions() const { return motions_; } // PO_OSxPI
  // Of the axes in `which`.
  void write(const rt::Memory& memory, devices::AxisMask which, const devices::AxisReport& report) const;

private:
  AxisBits enabled_, limitPlus_, limitMinus_, loops_, motions_, directions_;
  std::array<rt::Place, devices::kMaxAxes> positionEx_, incrementEx_;
  std::array<rt::Place, 6> positionShort_, incrementShort_;
  std::array<std::array<rt::Place, devices::kMaxAxes>, 5> positionOfSpaces_;
};

} // namespace rung::device_requests
