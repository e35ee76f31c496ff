// Spindles.
#include "sim/technol/devices/spindles.h"

#include <cmath>

namespace rung::sim::technol {

AnalogOutput Spindles::switchTo(Axis& axis, uint32_t number, SpindleRole role) {
  axis.spindle = true;
  return AnalogOutputs::switchTo(number, role);
}

uint32_t Spindles::role(const Axis& axis, uint32_t number) const {
  if (!axis.spindle || isOff(number)) return 0;
  return number == main() ? 1 : number == assistant() ? 2 : 3;
}

void Spindles::drive(Axis& axis, uint32_t number) const {
  if (!axis.spindle) return;
  axis.motion.run(output(number) * axis.attributes.speedAt10V / 60, axis.attributes.acceleration);
  // A spindle that is switched off and at rest returns to the position loop as an axis.
  if (isOff(number) && axis.motion.isAtRest()) axis.spindle = false;
}

// Spindle positioning.

namespace {

double orElse(const std::optional<int64_t>& operand, double scale, double attribute) {
  return operand ? static_cast<double>(*operand) * scale : attribute;
}

} // namespace

void SpindlePositioning::begin(Axis& axis, const SpindlePositioningOrder& order) {
  const AxisAttributes& own = axis.attributes;
  feed1_ = orElse(order.feed1, 0.001, own.refSpeedLow);
  feed2_ = orElse(order.feed2, 0.001, own.refSpeedLow);
  angle_ = orElse(order.angle, 0.001, own.posAfterRef) * (feed2_ < 0 ? -1 : 1);
  feed2_ = std::fabs(feed2_);
  acceleration_ = orElse(order.accel, 1, own.acceleration);
  if (!(acceleration_ > 0)) acceleration_ = own.acceleration;
  phase_ = Phase::Seek;
  fresh_ = true;
  armed_ = false;
  axis.spindle = false;
  axis.mover = Mover::SpindlePositioning;
  axis.forgetPulse();
  axis.request(feed1_ < 0);
}

void SpindlePositioning::drop(Axis& axis) {
  if (active()) end(axis, acceleration_);
}

void SpindlePositioning::end(Axis& axis, double acceleration) {
  phase_ = Phase::None;
  axis.brake(acceleration);
}

// Whether zero pulses count: from the edge of KRx on (RefSwitch 1), while it is on (2), or always (l.7858-7866,
// l.7905).
bool SpindlePositioning::pulsesCount(const Axis& axis, uint32_t index, const AxisInputs& in) {
  const bool now = has(in.refSwitch, index);
  const bool edge = now && !switchWas_ && !fresh_;
  switchWas_ = now;
  if (axis.attributes.refSwitch == 0) return true;
  armed_ = axis.attributes.refSwitch == 2 ? now : armed_ || edge;
  return armed_;
}

// l.7966-7973
bool SpindlePositioning::aborts(const Axis& axis, uint32_t index, const AxisInputs& in,
                                const AxisRequests& requests) const {
  if (!has(requests.positioning, index) || !has(in.enabled, index)) return true;
  return axis.attributes.manEnable == 2 && !has(in.manualEnabled, index);
}

void SpindlePositioning::drive(Axis& axis, uint32_t index, const AxisInputs& in, AxisRequests& requests, Stop stop) {
  if (!active()) return;
  if (fresh_) clearBit(requests.homing, index);
  const bool limit = atLimit(in, index, axis.negative);
  if (stop != Stop::None || limit || aborts(axis, index, in, requests)) {
    clearBit(requests.positioning, index);
    const bool hard = limit || stop == Stop::Emergency; // l.6688, l.6413
    return end(axis, hard ? axis.attributes.accelerationEmergency : acceleration_);
  }
  if (phase_ == Phase::Seek && pulsesCount(axis, index, in)) {
    axis.seekPulse(feed1_, acceleration_);
  } else if (phase_ == Phase::Seek) {
    axis.forgetPulse();
    axis.motion.run(feed1_ / 60, acceleration_);
  } else if (phase_ == Phase::Turn) {
    axis.motion.moveTo(axis.pulse() + angle_, feed2_ / 60, acceleration_);
  }
  fresh_ = false;
}

void SpindlePositioning::look(Axis& axis, uint32_t index, AxisRequests& requests) {
  if (phase_ == Phase::Seek && axis.passedPulse(axis.attributes.machineNullPoint)) phase_ = Phase::Overrun;
  const double target = axis.pulse() + angle_;
  if (phase_ == Phase::Overrun && axis.motion.isAtRest() && angle_ != 0) {
    phase_ = Phase::Turn;
    axis.request(target < axis.motion.position());
  }
  const bool there =
      phase_ == Phase::Overrun ? axis.motion.isAtRest() : phase_ == Phase::Turn && axis.motion.isAtRestAt(target);
  if (!there) return;
  end(axis, acceleration_);
  axis.requested = false;
  clearBit(requests.positioning, index);
  setBit(requests.homing, index); // it is a reference (l.11471)
}

} // namespace rung::sim::technol
