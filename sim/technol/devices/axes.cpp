// All axes, a millisecond at a time (see axes.h).
#include "sim/technol/devices/axes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rung::sim::technol {

void Axes::powerUp() {
  for (Axis& axis : axes_) axis.reset();
  positioning_ = {};
  spindles_.reset();
  units_.reset();
  reference_.reset();
  manual_.reset();
  complaints_ = {};
  operatorStop_ = Stop::None;
  stopPiWas_ = false;
  aborted_ = blockMotion_ = 0;
}

void Axes::fault() {
  operatorStop_ = Stop::Emergency; // of references and SPI_AX: their drives are disabled
  spindles_.zeroOutputs();
  units_.brakeAll();
  manual_.lock(true);
}

// STOPPI by its edge; the others are taken and reset (l.6396-6413).
Stop Axes::takeStop(const AxisInputs& in, AxisRequests& requests) {
  const bool edge = in.stopPi && !stopPiWas_;
  stopPiWas_ = in.stopPi;
  Stop stop = std::exchange(operatorStop_, Stop::None);
  if ((edge || requests.stopReq) && stop == Stop::None) stop = Stop::Normal;
  if (requests.stopEmergencyReq) stop = Stop::Emergency;
  requests.stopReq = requests.stopEmergencyReq = false;
  return stop;
}

// 1/min
double Axes::mainRevolutions() const {
  const uint32_t main = spindles_.main();
  return main == 0 ? 0 : std::fabs(speedPerMinute(main)) / kDegreesPerTurn;
}

void Axes::tick(const AxisInputs& in, AxisRequests& requests) {
  const Stop stop = takeStop(in, requests);
  const uint32_t count = this->count();
  blockMotion_ = in.blockMotion;
  requests.positioning = static_cast<AxisMask>(requests.positioning & ~std::exchange(aborted_, {}));
  for (uint32_t i = 0; i < count; ++i) positioning_[i].drive(axes_[i], i, in, requests, stop);
  for (uint32_t i = 0; i < count; ++i) units_.drive(axes_[i], i + 1, in);
  reference_.drive(existing(), in, requests, stop, complaints_);
  manual_.drive(existing(), in, requests, mainRevolutions());
  for (uint32_t i = 0; i < count; ++i) spindles_.drive(axes_[i], i + 1);

  for (Axis& axis : existing()) axis.tick();

  for (uint32_t i = 0; i < count; ++i) positioning_[i].look(axes_[i], i, requests);
  for (uint32_t i = 0; i < count; ++i) units_.look(axes_[i], i + 1);
  reference_.look(existing(), requests);
}

void Axes::show(AxisOutputs& out) const {
  out.motion = blockMotion_;
  out.negative = out.movedByHand = 0;
  out.inPosition = true;
  for (uint32_t i = 0; i < count(); ++i) {
    const Axis& axis = axes_[i];
    if (axis.requested) setBit(out.motion, i);
    if (axis.negative) setBit(out.negative, i);
    if (axis.moves() && !axis.spindle) out.inPosition = false;
    if (axis.mover == Mover::Manual) setBit(out.movedByHand, i);
    out.speed[i] = axis.motion.speed() * 60;
    out.shiftSpeed[i] = axis.shift.speed() * 60;
    out.position[i] = axis.measured();
    out.place(i, axis.measured());
  }
  out.reference = reference_.underWay(existing());
  manual_.show(existing(), out);
}

} // namespace rung::sim::technol
