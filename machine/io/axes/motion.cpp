// Trapezoids (see motion.h).
#include "machine/io/axes/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rung::io {
namespace {

constexpr double kNsInSecond = 1e9;
constexpr double kForever = std::numeric_limits<double>::infinity();
// What differs by less is equal: a nanometre and a nanosecond are far above what rounding does, far below what counts.
constexpr double kEqual = 1e-9;

double sign(double value) { return value < 0 ? -1 : 1; }
// Where a motion of that speed comes to a standstill, from here.
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

// By the highest speed from which it can still brake, as the target lies ahead.
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

} // namespace rung::io
