// Where the cells of the axes lie in a program (inventory of the services, 1.6, 15.1), and their way to the axes of the
// simulated control and back.
#pragma once
#include <array>
#include <vector>

#include "rtlib/core/memory.h"
#include "tools/sim/technol/devices/axis_cells.h"

namespace rung::sim::technol {

// The names that a bit of each axis has: `#` in the pattern is X, Y, Z and the numbers from 4 on, `%` the number.
std::string nameOfAxis(std::string_view pattern, uint32_t axis);

class AxisPlaces {
public:
  AxisPlaces() = default; // a program that has nothing
  explicit AxisPlaces(const rung_program& program);

  // Before the ticks of a scan. Of `in.blockMotion` stays what PO_OSxPI still says.
  void read(const rt::Memory& memory, AxisInputs& in, AxisRequests& requests) const;
  AxisMask motion(const rt::Memory& memory) const { return maskOf(memory, motion_); }
  // After them, for axes 1 to `count`.
  void write(const rt::Memory& memory, uint32_t count, AxisMask blockMotion, const AxisRequests& requests,
             const AxisOutputs& out) const;
  bool isLoopClosed(const rt::Memory& memory, uint32_t axis) const { return memory.read(loop_[axis - 1]) != 0; }
  void zeroOutputs(const rt::Memory& memory) const;

private:
  using Bits = std::array<rt::Place, kMaxAxes>;
  static AxisMask maskOf(const rt::Memory& memory, const Bits& bits);
  static void putMask(const rt::Memory& memory, const Bits& bits, uint32_t count, AxisMask mask);

  std::vector<Bits> inputMasks_, outputMasks_; // in the order of their tables
  std::vector<rt::Place> inputFlags_, outputFlags_, requestFlags_, requestMasks_;
  Bits loop_, positioning_, motion_, direction_;
  rt::Place feedOverride_, feedMultiplier_, feed_, rapidFeed_, shiftEnable_, knobStep_, shiftControl_;
  std::array<rt::Place, kMaxAxes> refpointDist_, servoPosition_, positionEx_, incrementEx_, knobSelected_, output_;
  std::array<rt::Place, 6> positionShort_, incrementShort_, shift_;
  std::array<std::array<rt::Place, kMaxAxes>, 5> positionOfSpaces_;
};

} // namespace rung::sim::technol
