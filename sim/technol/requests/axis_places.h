// Where the cells of the axes lie in a program (inventory of the services, 1.6, 15.1), and their way to the axes of the
// simulated control and back.
#pragma once
#include <array>
#include <vector>

#include "machine/io/axes/axis_cells.h"
#include "rtlib/core/memory.h"
#include "sim/technol/devices/axis_cells.h"

namespace rung::sim::technol {

class AxisPlaces {
public:
  AxisPlaces() = default; // a program that has nothing
  explicit AxisPlaces(const rung_program& program);

  // Before the ticks of a scan. Of `in.blockMotion` stays what PO_OSxPI still says.
  void read(const core::Memory& memory, AxisInputs& in, AxisRequests& requests) const;
  const io::AxisCells& cells() const { return cells_; }
  // After them, for axes 1 to `count`.
  void write(const core::Memory& memory, uint32_t count, const AxisRequests& requests, const AxisOutputs& out) const;
  void zeroOutputs(const core::Memory& memory) const;

private:
  io::AxisCells cells_;
  std::vector<io::AxisBits> inputMasks_, outputMasks_; // in the order of their tables
  std::vector<core::Place> inputFlags_, outputFlags_, requestFlags_, requestMasks_;
  io::AxisBits positioning_;
  core::Place feedOverride_, feedMultiplier_, feed_, rapidFeed_, shiftEnable_, knobStep_, shiftControl_;
  std::array<core::Place, kMaxAxes> refpointDist_, servoPosition_, knobSelected_, output_;
  std::array<core::Place, 6> shift_;
};

} // namespace rung::sim::technol
