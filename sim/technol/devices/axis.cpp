// One axis.
#include "sim/technol/devices/axis.h"

#include <cmath>

namespace rung::sim::technol {

namespace {

constexpr double kNear = 1e-9; // a pulse at the position of the axis is not ahead of it

} // namespace

void Axis::reset() {
  const AxisAttributes kept = attributes;
  *this = Axis();
  attributes = kept;
  setPhysical(kept.position);
  setMeasured(0);
}

void Axis::setPhysical(double place) {
  motion.place(place - shift.position());
  forgetPulse();
}

void Axis::brake(double acceleration) {
  forgetPulse();
  leave(acceleration);
}

void Axis::tick() {
  motion.tick();
  shift.tick();
  if (mover == Mover::None && (spindle || motion.isAtRest())) requested = false;
}

double Axis::nextPulse(double from, bool downwards) const {
  const double pitch = attributes.pitch();
  const double zero = attributes.zeroPulseAt - shift.position();
  const double count = (from - zero) / pitch;
  return zero + pitch * (downwards ? std::ceil(count - kNear) - 1 : std::floor(count + kNear) + 1);
}

void Axis::seekPulse(double perMinute, double acceleration) {
  const double speed = perMinute / 60;
  if (speed == 0) return motion.stop(acceleration);
  if (!seeks_ || seeksDownwards_ != (speed < 0)) {
    seeks_ = true;
    seeksDownwards_ = speed < 0;
    pulse_ = nextPulse(motion.inRange(speed, acceleration), seeksDownwards_);
  }
  motion.runPast(pulse_, speed, acceleration);
}

bool Axis::passedPulse(double value) {
  if (!seeks_) return false;
  const double beyond = motion.position() - pulse_;
  if (seeksDownwards_ ? beyond > 0 : beyond < 0) return false;
  seeks_ = false;
  offset_ = value - pulse_;
  return true;
}

} // namespace rung::sim::technol
