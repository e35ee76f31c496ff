// SPI_AX (man. l.7821-7973): an axis goes from the speed loop to the position loop, travels to its zero pulse and by an
// additional angle. One object an axis; several axes at the same time.
#pragma once
#include <cstdint>
#include <optional>

#include "sim/technol/devices/axis_cells.h"

namespace rung::sim::technol {

// Operands that are not given are attributes of the axis.
struct SpindlePositioningOrder {
  std::optional<int64_t> feed1; // 1/1000 °/min, signed (l.7890); else RefSpeedLow
  std::optional<int64_t> feed2; // 1/1000 °/min (l.7908); negative: turns the sign of the angle
  std::optional<int64_t> angle; // 1/1000 ° from the zero pulse (l.7920), 0: none; else PosAfterRef
  std::optional<int64_t> accel; // mm/s² (l.7931); else Acceleration
};

class SpindlePositioning {
public:
  bool active() const { return phase_ != Phase::None; }
  void begin(Axis& axis, const SpindlePositioningOrder& order);
  // The axis is taken from it: it brakes.
  void drop(Axis& axis);
  // A millisecond: before the axis moves, and after.
  void drive(Axis& axis, uint32_t index, const AxisInputs& in, AxisRequests& requests, Stop stop);
  void look(Axis& axis, uint32_t index, AxisRequests& requests);

private:
  enum class Phase : uint8_t { None, Seek, Overrun, Turn };
  bool pulsesCount(const Axis& axis, uint32_t index, const AxisInputs& in);
  bool aborts(const Axis& axis, uint32_t index, const AxisInputs& in, const AxisRequests& requests) const;
  void end(Axis& axis, double acceleration);

  Phase phase_ = Phase::None;
  bool fresh_ = false; // HOMING is to be reset
  bool switchWas_ = false, armed_ = false;
  double feed1_ = 0, feed2_ = 0; // per minute
  double angle_ = 0, acceleration_ = 0;
};

} // namespace rung::sim::technol
