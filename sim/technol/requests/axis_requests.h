// The places of the axis cells in a program (inventory of the services, 1.6, 15.1), and their transfer to and from the
// axes of the simulated control.
#pragma once
#include <array>
#include <vector>

#include "machine/io/axes/axis_requests.h"
#include "machine/io/device_call.h"
#include "rtlib/core/memory.h"
#include "rtlib/run/instance.h"
#include "sim/technol/devices/axes.h"
#include "sim/technol/devices/axis.h"
#include "sim/technol/devices/ethercat_servo.h"

namespace rung::sim::technol {

class AxisPlaces {
public:
  AxisPlaces() = default; // for a program without these cells
  explicit AxisPlaces(const rung_program& program);

  // To be called before the ticks of a scan. `in.blockMotion` keeps only axes with PO_OSxPI.
  void read(const core::Memory& memory, AxisInputs& in, AxisRequests& requests) const;
  const io::AxisCells& cells() const { return cells_; }
  // To be called after the ticks, for axes 1 to `count`.
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

// Instructions of spindles, servos and positioning units, answered by the axes of the simulated control (man. ch. 12,
// 13.1, 19).

void answerAxis(Axes& axes, const AxisPlaces& places, io::DeviceCall& call);

// Cells of EtherCAT drives (man. 13.18, 13.19).

class ServoPlaces {
public:
  ServoPlaces() = default; // for a program without these cells
  explicit ServoPlaces(const rung_program& program);

  void read(const core::Memory& memory, EthercatServos::Cells& servos) const;
  // Writes the cells of drives that are simulated or connected.
  void write(const core::Memory& memory, const EthercatServos::Cells& servos) const;

private:
  using OfServos = std::array<core::Place, EthercatServos::kCount>;
  static constexpr uint32_t kFlags = 9, kWords = 6;
  std::array<std::array<core::Place, kFlags>, EthercatServos::kCount> flags_;
  std::array<std::array<core::Place, kWords>, EthercatServos::kCount> words_;
  OfServos position_, velocityScale_;
  // Micrometres, micrometres, micrometres, increments (l.10390-10396).
  OfServos followingError_, requested_, measured_, increments_;
};

} // namespace rung::sim::technol
