// Spindles of the simulated control (man. chapter 12): analogue outputs with the axes that they turn, and parameter
// sets of the regulators (l.8443-8460). Ports and axes are numbered from 1; 0 is none.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "machine/io/analog/analog.h"
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

  // 0 axis, or spindle switched off; 1 main, 2 assistant, 3 spindle without a role.
  uint32_t role(const Axis& axis, uint32_t number) const;
  uint32_t regulator(uint32_t axis) const { return regulators_[axis - 1]; }
  // The spindle follows its output with the ramp `Acceleration`.
  void drive(Axis& axis, uint32_t number) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(regulators_);
    io::AnalogOutputs::state(archive);
  }

private:
  std::array<uint8_t, kMaxAxes> regulators_ = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}; // l.8443
};

// SPI_AX (man. l.7821-7973): switches an axis from the speed loop to the position loop and moves it to its zero pulse
// and by an additional angle. One object per axis; several axes may be active at the same time.

// Missing operands are replaced by attributes of the axis.
struct SpindlePositioningOrder {
  std::optional<int64_t> feed1; // 1/1000 °/min, signed (l.7890); otherwise RefSpeedLow
  std::optional<int64_t> feed2; // 1/1000 °/min (l.7908); negative: inverts the sign of the angle
  std::optional<int64_t> angle; // 1/1000 ° from the zero pulse (l.7920), 0: none; otherwise PosAfterRef
  std::optional<int64_t> accel; // mm/s² (l.7931); otherwise Acceleration
};

class SpindlePositioning {
public:
  bool active() const { return phase_ != Phase::None; }
  void begin(Axis& axis, const SpindlePositioningOrder& order);
  // Another mover takes the axis: it brakes.
  void drop(Axis& axis);
  // One millisecond: `drive` before the axis moves, `look` after it.
  void drive(Axis& axis, uint32_t index, const AxisInputs& in, AxisRequests& requests, Stop stop);
  void look(Axis& axis, uint32_t index, AxisRequests& requests);

  template <class Archive>
  void state(Archive& archive) {
    archive(phase_, fresh_, switchWas_, armed_, feed1_, feed2_, angle_, acceleration_);
  }

private:
  enum class Phase : uint8_t { None, Seek, Overrun, Turn };
  bool pulsesCount(const Axis& axis, uint32_t index, const AxisInputs& in);
  bool aborts(const Axis& axis, uint32_t index, const AxisInputs& in, const AxisRequests& requests) const;
  void end(Axis& axis, double acceleration);

  Phase phase_ = Phase::None;
  bool fresh_ = false; // HOMING must be reset
  bool switchWas_ = false, armed_ = false;
  double feed1_ = 0, feed2_ = 0; // per minute
  double angle_ = 0, acceleration_ = 0;
};

} // namespace rung::sim::technol
