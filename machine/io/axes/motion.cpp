// See motion.h.
#include "machine/io/axes/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rung::io {

namespace {

constexpr double kNsInSecond = 1e9;
constexpr double kForever = std::numeric_limits<double>::infinity();
// Smaller differences count as none: a nanometre and a nanosecond are far above rounding errors and far below any
// relevant difference.
constexpr double kEqual = 1e-9;

double sign(double value) { return value < 0 ? -1 : 1; }
// The distance to the standstill of a motion at this speed.
double brakingDistance(double speed, double acceleration) { return speed * std::fabs(speed) / (2 * acceleration); }

} // namespace

void Motion::place(double position) {
  position_ = position;
  speed_ = 0;
  order_ = {};
  count_ = phase_ = 0;
  time_ = duration_ = 0;
}

bool Motion::isNew(const Order& order) {
  if (order == order_) return false;
  order_ = order;
  count_ = phase_ = 0;
  ns_ = 0;
  time_ = 0;
  last_ = {.begin = 0, .position = position_, .speed = speed_, .acceleration = 0};
  return true;
}

void Motion::append(double seconds, double acceleration, double endPosition, double endSpeed) {
  if (!(seconds > 0) || count_ == kPhases) return;
  last_.acceleration = acceleration;
  phases_[count_++] = last_;
  last_ = {.begin = last_.begin + seconds, .position = endPosition, .speed = endSpeed, .acceleration = 0};
}

void Motion::rampTo(double speed, double acceleration) {
  const double change = speed - last_.speed;
  const double seconds = std::fabs(change) / acceleration;
  append(seconds, sign(change) * acceleration, last_.position + (last_.speed + speed) / 2 * seconds, speed);
}

void Motion::cruise(double distance) {
  const double v = last_.speed;
  if (distance * v > 0) append(distance / v, 0, last_.position + distance, v);
}

void Motion::end(double position, double speed) {
  last_ = {.begin = last_.begin, .position = position, .speed = speed, .acceleration = 0};
  duration_ = last_.begin;
  if (duration_ == 0) position_ = position;
}

void Motion::run(double speed, double acceleration) {
  if (!isNew({Kind::Run, 0, speed, acceleration})) return;
  rampTo(speed, acceleration);
  end(last_.position, speed);
  if (speed == 0) return;
  append(1, 0, last_.position, speed);
  duration_ = kForever;
}

void Motion::moveTo(double target, double speed, double acceleration) {
  if (!(speed > 0)) return stop(acceleration);
  if (!isNew({Kind::To, target, speed, acceleration})) return;
  const double v = last_.speed;
  const double beyond = target - last_.position - brakingDistance(v, acceleration); // from the standstill to the target
  if (std::fabs(beyond) < kEqual || beyond * v < 0 || (target - last_.position) * v < 0) rampTo(0, acceleration);
  if (std::fabs(target - last_.position) >= kEqual) approach(target, speed, acceleration);
  end(target, 0);
}

// Approaches a target ahead, with the highest speed from which the axis can still brake.
void Motion::approach(double target, double speed, double acceleration) {
  const double distance = target - last_.position;
  const double u = last_.speed;
  const double peak = std::sqrt(acceleration * std::fabs(distance) + u * u / 2);
  rampTo(sign(distance) * std::min(speed, peak), acceleration);
  cruise(target - last_.position - brakingDistance(last_.speed, acceleration));
  rampTo(0, acceleration);
}

double Motion::inRange(double speed, double acceleration) const {
  const double forward = speed_ * sign(speed);
  if (forward < 0) return position_ + brakingDistance(speed_, acceleration);
  if (forward <= std::fabs(speed)) return position_;
  return position_ + brakingDistance(speed_, acceleration) - brakingDistance(speed, acceleration);
}

void Motion::runPast(double position, double speed, double acceleration) {
  if (speed == 0) return stop(acceleration);
  if (!isNew({Kind::Past, position, speed, acceleration})) return;
  const double direction = sign(speed);
  if (last_.speed * direction < 0) rampTo(0, acceleration);
  if (std::fabs(last_.speed) > std::fabs(speed)) rampTo(speed, acceleration);
  const double distance = std::max(0., (position - last_.position) * direction);
  const double reached = std::sqrt(last_.speed * last_.speed + 2 * acceleration * distance);
  rampTo(direction * std::min(std::fabs(speed), reached), acceleration);
  cruise(position - last_.position);
  const double standstill = position + brakingDistance(last_.speed, acceleration);
  rampTo(0, acceleration);
  end(standstill, 0);
}

void Motion::advance(int64_t ns) {
  if (time_ >= duration_) return;
  ns_ += ns;
  time_ = static_cast<double>(ns_) / kNsInSecond;
  if (time_ >= duration_ - kEqual) {
    time_ = duration_;
    position_ = last_.position;
    speed_ = last_.speed;
    return;
  }
  while (phase_ + 1 < count_ && time_ >= phases_[phase_ + 1].begin) ++phase_;
  const Phase& now = phases_[phase_];
  const double t = time_ - now.begin;
  position_ = now.position + (now.speed + now.acceleration * t / 2) * t;
  speed_ = now.speed + now.acceleration * t;
}

// Positioning units.

const PositioningUnits::Unit* PositioningUnits::find(uint32_t number) const {
  const auto* const found = std::ranges::find(units_, number, &Unit::axis);
  return found == units_.end() ? nullptr : found;
}

// The unit of the axis, or a free one; null for the seventh axis.
PositioningUnits::Unit* PositioningUnits::unitFor(uint32_t number) {
  Unit* const own = find(number);
  return own != nullptr ? own : find(0);
}

void PositioningUnits::init(DrivenAxis& axis, uint32_t number, bool allowed) {
  Unit* const unit = allowed ? unitFor(number) : nullptr;
  if (unit == nullptr) return fail(number);
  clearBit(errors_, number - 1);
  const double acceleration = unit->acceleration > 0 ? unit->acceleration : axis.attributes.acceleration;
  *unit = {.axis = number, .acceleration = acceleration};
  axis.mover = Mover::PositioningUnit;
  unit->braking = !axis.motion.isAtRest();
  axis.motion.stop(acceleration);
}

PositioningUnits::Mode PositioningUnits::program(const DrivenAxis& axis, uint32_t number, int32_t length,
                                                 uint16_t acceleration) {
  Unit* const unit = find(number);
  const bool moving = unit != nullptr && unit->underWay() && (unit->started || !axis.motion.isAtRest());
  if (unit == nullptr || acceleration == 0 || (moving && !unit->braking)) {
    fail(number);
    return {};
  }
  const bool braking = unit->braking;
  *unit = {.axis = number, .programmed = true, .braking = braking};
  unit->acceleration = acceleration;
  unit->length = length / 1000.;
  return {.accepted = true, .control = controlOf(*unit)};
}

PositioningUnits::State PositioningUnits::control(const DrivenAxis& axis, uint32_t number, uint32_t feed, bool mp) {
  Unit* const unit = find(number);
  if (unit == nullptr) return {.status = statusOf(axis, number)};
  unit->feed = feed / 65536. / 60;
  unit->mp = mp;
  return {.status = statusOf(axis, number), .programmed = unit->programmed, .control = controlOf(*unit)};
}

void PositioningUnits::release(DrivenAxis& axis, uint32_t number) {
  Unit* const unit = find(number);
  if (unit == nullptr) return;
  axis.leave(unit->acceleration);
  *unit = {};
}

void PositioningUnits::lose(DrivenAxis& axis, uint32_t number) {
  if (!holds(number)) return;
  release(axis, number);
  fail(number);
}

void PositioningUnits::brakeAll() {
  for (Unit& unit : units_) {
    unit.feed = 0;
    unit.mp = false;
  }
}

uint8_t PositioningUnits::controlOf(const Unit& unit) {
  const uint8_t mp = unit.mp ? kControlMp : 0;
  if (!unit.underWay()) return mp;
  return static_cast<uint8_t>(mp | (unit.initiated ? kControlContinue : kControlInit));
}

uint16_t PositioningUnits::statusOf(const DrivenAxis& axis, uint32_t number) const {
  uint32_t status = has(errors_, number - 1) ? kUnitError : 0;
  const Unit* const unit = find(number);
  if (unit == nullptr) return static_cast<uint16_t>(status);
  status |= kUnitAvailable;
  if (axis.motion.speed() != 0) status |= kUnitMoves;
  if (unit->length < 0) status |= kUnitNegative;
  if (unit->arrived) status |= kUnitArrived;
  if (unit->programmed) status |= kUnitProgrammed;
  return static_cast<uint16_t>(status);
}

void PositioningUnits::drive(DrivenAxis& axis, uint32_t number, const AxisPermits& in) {
  Unit* const unit = find(number);
  if (unit == nullptr) return;
  if (unit->braking && axis.motion.isAtRest()) unit->braking = false;
  if (!unit->braking && unit->underWay()) follow(*unit, axis, number - 1, in);
  if (!unit->underWay() && axis.motion.isAtRest()) axis.requested = false;
}

void PositioningUnits::follow(Unit& unit, DrivenAxis& axis, uint32_t index, const AxisPermits& in) {
  if (!unit.placed) unit.target = axis.motion.position() + unit.length;
  unit.placed = unit.initiated = true;
  const bool wanted = unit.mp && unit.feed > 0;
  const bool negative = unit.length < 0;
  const Hold hold = holdOf(in, index, negative, in.enabled);
  if (wanted && hold == Hold::None) {
    axis.motion.moveTo(unit.target, std::min(unit.feed, axis.attributes.feedRT / 60), unit.acceleration);
  } else {
    axis.motion.stop(hold == Hold::Limit ? axis.attributes.accelerationEmergency : unit.acceleration); // l.6692
  }
  axis.request(negative);
  axis.requested = wanted || !axis.motion.isAtRest();
}

void PositioningUnits::look(DrivenAxis& axis, uint32_t number) {
  Unit* const unit = find(number);
  if (unit == nullptr || !unit->underWay() || !unit->placed) return;
  if (axis.motion.speed() != 0) unit->started = true;
  if (!axis.motion.isAtRestAt(unit->target) || !axis.settled) return;
  unit->arrived = true;
  axis.requested = false;
}

} // namespace rung::io
