// Reference.
#include "sim/technol/devices/reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rung::sim::technol {

namespace {

// Calls act(i) for each existing axis of the mask.
void forBits(AxisMask mask, size_t count, auto act) {
  for (uint32_t i = 0; i < count; ++i)
    if (has(mask, i)) act(i);
}

} // namespace

AxisMask Reference::take(ReferenceKind kind) { return std::exchange(ordered_[static_cast<uint32_t>(kind)], {}); }

void Reference::drop(Axis& axis, uint32_t index) { travels_[index].end(axis, axis.attributes.accelerationRT); }

bool Reference::begin(Axis& axis, uint32_t index, AxisRequests& requests, Complaints& complaints) {
  std::string_view reason;
  if (axis.attributes.method() == 1)
    reason = " has RefMethod 1: the PLC references it";
  else if (axis.spindle)
    reason = " is a spindle";
  else if (axis.mover != Mover::None && axis.mover != Mover::Reference)
    reason = " is moved otherwise";
  if (!reason.empty()) {
    complaints.add({"reference", "axis", index + 1, reason});
    return false;
  }
  clearBit(requests.homing, index);
  travels_[index].begin(axis);
  return true;
}

// The system references the axis, or requests this from the program (l.11497, l.11775).
void Reference::takeSingles(std::span<Axis> axes, AxisRequests& requests, Complaints& complaints) {
  AxisMask asked = 0;
  forBits(take(ReferenceKind::Single), axes.size(), [&](uint32_t i) {
    const bool byProgram = axes[i].attributes.method() == 1 || axes[i].attributes.refViaPlc != 0;
    if (byProgram)
      setBit(asked, i);
    else
      begin(axes[i], i, requests, complaints);
  });
  if (asked == 0) return;
  requests.homingSingle = true;
  requests.homingAxes = asked;
}

void Reference::takeOrders(std::span<Axis> axes, AxisRequests& requests, Complaints& complaints) {
  takeSingles(axes, requests, complaints);
  if (const AxisMask mask = take(ReferenceKind::Plc); mask != 0) {
    requests.homingPlc = true;
    requests.homingAxes = mask;
  }
  if (const AxisMask mask = take(ReferenceKind::Group); mask != 0) {
    requests.homingGroup = true;
    requests.homingAxes = mask;
  }
  forBits(take(ReferenceKind::Pseudo), axes.size(), [&](uint32_t i) {
    axes[i].setMeasured(0);
    setBit(requests.homing, i);
    clearBit(requests.nonlinearEnable, i);
    clearBit(requests.softLimits, i);
  });
  forBits(take(ReferenceKind::Simulated), axes.size(), [&](uint32_t i) { setBit(requests.homing, i); });
  forBits(take(ReferenceKind::Clear), axes.size(), [&](uint32_t i) { clearBit(requests.homing, i); });
}

void Reference::takeRequests(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests,
                             Complaints& complaints) {
  forBits(requests.homingReq, axes.size(), [&](uint32_t i) { // l.11779
    const double shift = static_cast<double>(in.refpointDist[i]) / 65536 / 1000;
    axes[i].setMeasured(axes[i].attributes.machineNullPoint + shift);
    clearBit(requests.homingReq, i);
  });
  forBits(requests.homingStartReq, axes.size(), [&](uint32_t i) { // l.11744
    if (!travels_[i].active() && !begin(axes[i], i, requests, complaints)) clearBit(requests.homingStartReq, i);
  });
}

void Reference::stopAll(std::span<Axis> axes, AxisRequests& requests, Stop stop) {
  for (uint32_t i = 0; i < axes.size(); ++i) {
    if (!travels_[i].active()) continue;
    const AxisAttributes& own = axes[i].attributes;
    travels_[i].end(axes[i], stop == Stop::Emergency ? own.accelerationEmergency : own.accelerationRT);
    clearBit(requests.homingStartReq, i);
  }
}

void Reference::drive(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, Stop stop,
                      Complaints& complaints) {
  takeOrders(axes, requests, complaints);
  takeRequests(axes, in, requests, complaints);
  if (stop != Stop::None) stopAll(axes, requests, stop);
  for (uint32_t i = 0; i < axes.size(); ++i) travels_[i].drive(axes[i], i, in);
}

void Reference::look(std::span<Axis> axes, AxisRequests& requests) {
  for (uint32_t i = 0; i < axes.size(); ++i) {
    if (!travels_[i].look(axes[i])) continue;
    setBit(requests.homing, i);
    clearBit(requests.homingStartReq, i);
  }
}

bool Reference::underWay(std::span<const Axis> axes) const {
  for (uint32_t i = 0; i < axes.size(); ++i)
    if (travels_[i].active() && isActualTravel(axes[i].attributes.method())) return true;
  return false;
}

// Reference travels.

namespace {

// RefMethod (l.11475).
constexpr uint32_t kCodedDistances = 5, kFast = 9, kWithoutReversal = 11, kSimulated = 13, kAbsolute = 14;

// 12 and 15 align several servos of an axis; here each has one, whose switch is REF_SERV_n.
bool seenSwitch(uint32_t method, uint32_t index, const AxisInputs& in) {
  return has(method == 12 || method == 15 ? in.servoSwitch : in.refSwitch, index);
}

} // namespace

bool isActualTravel(uint32_t method) { return method != kSimulated && method != kAbsolute; }

void ReferenceTravel::begin(Axis& axis) {
  *this = {};
  phase_ = Phase::Seek;
  fresh_ = true;
  negative_ = axis.attributes.invertRefDirection != 0;
  from_ = axis.motion.position();
  axis.mover = Mover::Reference;
  axis.forgetPulse();
  axis.request(negative_);
}

void ReferenceTravel::end(Axis& axis, double acceleration) {
  if (!active()) return;
  phase_ = Phase::None;
  axis.brake(acceleration);
}

void ReferenceTravel::zeroHere(Axis& axis, double value) {
  axis.setMeasured(value);
  axis.motion.stop(axis.attributes.accelerationRT);
  phase_ = Phase::Overrun;
}

// Method 9: KRRx reverses once, ZPRx slows down, KRx enables zero pulses.
void ReferenceTravel::observeZeroPulse(const AxisAttributes& own, uint32_t index, const AxisInputs& in) {
  const bool on = has(in.refSwitch, index);
  const bool edge = on && !switchWas_ && !fresh_;
  switchWas_ = on;
  if (has(in.reverseSwitch, index) && !reversed_ && !armed_) {
    reversed_ = true;
    negative_ = !negative_;
  }
  armed_ = own.refSwitch == 0 || (own.refSwitch == 2 ? on : armed_ || edge);
  low_ = low_ || armed_;
}

// Methods 10, 12, 15: the switch reverses the travel, and the zero point is where it opens again.
void ReferenceTravel::observeSwitch(Axis& axis, bool on) {
  if (phase_ == Phase::Seek && on) {
    phase_ = Phase::Leave;
    negative_ = !negative_;
    low_ = true;
  }
  const bool returns = negative_ ? axis.motion.speed() < 0 : axis.motion.speed() > 0;
  if (phase_ == Phase::Leave && returns && switchWas_ && !on) zeroHere(axis, axis.attributes.machineNullPoint);
  switchWas_ = on;
}

void ReferenceTravel::observe(Axis& axis, uint32_t index, const AxisInputs& in) {
  const AxisAttributes& own = axis.attributes;
  const uint32_t method = own.method();
  const double sense = own.invertRefDirection != 0 ? -1 : 1;
  if (has(in.slowSwitch, index) && (own.slowDownSwitch != 0 || method == kWithoutReversal)) low_ = true;
  switch (method) {
  case kCodedDistances: // the distance of two marks is unique: the position is known after a pitch
    if (std::fabs(axis.motion.position() - from_) < own.pitch()) return;
    return zeroHere(axis, own.machineNullPoint + axis.physical() - own.zeroPulseAt);
  case kFast: return observeZeroPulse(own, index, in);
  case kWithoutReversal:
    if (has(in.refSwitch, index)) zeroHere(axis, own.machineNullPoint);
    return;
  case kSimulated: return zeroHere(axis, own.machineNullPoint);
  case kAbsolute: return zeroHere(axis, own.machineNullPoint + sense * in.servoPosition[index] / 1000.);
  default: return observeSwitch(axis, seenSwitch(method, index, in));
  }
}

void ReferenceTravel::drive(Axis& axis, uint32_t index, const AxisInputs& in) {
  if (!active()) return;
  if (phase_ == Phase::Seek || phase_ == Phase::Leave) observe(axis, index, in);
  fresh_ = false;
  if (phase_ == Phase::Overrun) return;
  axis.request(phase_ == Phase::Further ? target(axis) < axis.motion.position() : negative_);
  if (holdOf(in, index, axis.negative, in.enabled) == Hold::None) return move(axis, in);
  axis.forgetPulse();
  axis.motion.stop(axis.attributes.accelerationEmergency); // l.6424, l.6688
}

void ReferenceTravel::move(Axis& axis, const AxisInputs& in) const {
  const AxisAttributes& own = axis.attributes;
  const double factor = own.feedOvrDuringRef != 0 ? 1 : in.override(); // l.11577
  const double speed = std::min((low_ ? own.refSpeedLow : own.refSpeed) * factor, own.feedRT);
  if (phase_ == Phase::Further)
    return axis.motion.moveTo(target(axis), own.refSpeedLow * factor / 60, own.accelerationRT);
  if (phase_ == Phase::Seek && armed_) return axis.seekPulse(negative_ ? -speed : speed, own.accelerationRT);
  axis.forgetPulse();
  axis.motion.run((negative_ ? -speed : speed) / 60, own.accelerationRT);
}

double ReferenceTravel::target(const Axis& axis) const {
  const AxisAttributes& own = axis.attributes;
  return axis.placeOf(own.posAfterRef + (own.moveToPosAfterRef == 1 ? own.machineNullPoint : 0));
}

bool ReferenceTravel::look(Axis& axis) {
  const AxisAttributes& own = axis.attributes;
  if (phase_ == Phase::Seek && armed_ && axis.passedPulse(own.machineNullPoint)) phase_ = Phase::Overrun;
  if (phase_ == Phase::Overrun && axis.motion.isAtRest() && own.moveToPosAfterRef != 0) phase_ = Phase::Further;
  const bool there = phase_ == Phase::Overrun ? axis.motion.isAtRest()
                                              : phase_ == Phase::Further && axis.motion.isAtRestAt(target(axis));
  if (!there) return false;
  end(axis, own.accelerationRT);
  axis.requested = false;
  return true;
}

} // namespace rung::sim::technol
