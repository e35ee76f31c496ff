// Spindles of the simulated control (man. chapter 12): analogue outputs with the axes that they turn, and parameter
// sets of the regulators (l.8443-8460). Ports and axes are numbered from 1, 0 is none.
#pragma once
#include <array>
#include <cstdint>

#include "machine/io/analog/analog_outputs.h"
#include "sim/technol/devices/axis.h"

namespace rung::sim::technol {

using io::AnalogOutput;
using io::kFullOutput;
using io::SpindleRole;
inline constexpr uint32_t kPorts = io::kAnalogPorts;
inline constexpr int64_t kRegulatorSets = io::kRegulatorSets;

class Spindles : public io::AnalogOutputs {
public:
  void reset() { *this = Spindles(); }

  // AX_SPI axis[,spi].
  AnalogOutput switchTo(Axis& axis, uint32_t number, SpindleRole role);
  // REGUL_X to REGUL_6.
  void setRegulator(uint32_t axis, uint32_t set) { regulators_[axis - 1] = static_cast<uint8_t>(set); }

  // 0 axis, or spindle switched off; 1 main, 2 assistant, 3 spindle without role.
  uint32_t role(const Axis& axis, uint32_t number) const;
  uint32_t regulator(uint32_t axis) const { return regulators_[axis - 1]; }
  // The spindle follows its output by the ramp `Acceleration`.
  void drive(Axis& axis, uint32_t number) const;

private:
  std::array<uint8_t, kMaxAxes> regulators_ = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}; // l.8443
};

} // namespace rung::sim::technol
