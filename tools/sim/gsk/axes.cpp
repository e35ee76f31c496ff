// Axes of the simulated CNC (see axes.h).
#include "tools/sim/gsk/axes.h"

#include <cmath>
#include <cstdlib>

namespace rung::sim::gsk {

void Axes::beginSlot(const nc::gsk::SignalsIo& io, Alarms& alarms) {
  locked_ = io.g(44, 1);       // MLK l.5309
  interlocked_ = !io.g(8, 0);  // *IT l.3650
  noPositive_ = io.gByte(132); // +MIT l.3667
  noNegative_ = io.gByte(134); // -MIT
  if (!limitSwitches) return;
  for (uint32_t i = 0; i < count(); ++i) {
    const bool positive = !io.g(114, i); // l.3599
    const bool negative = !io.g(116, i);
    if (positive) alarms.raise(kAlarmOverTravel + i + 1);
    if (negative) alarms.raise(kAlarmOverTravel + 10 + i + 1);
    axes_[i].blockedPositive |= positive;
    axes_[i].blockedNegative |= negative;
  }
}

void Axes::clearOverTravel() {
  for (Axis& axis : axes_) axis.blockedPositive = axis.blockedNegative = false;
}

bool Axes::mayMove(uint32_t axis, bool negative) const {
  if (interlocked_ || (((negative ? noNegative_ : noPositive_) >> axis) & 1) != 0) return false;
  return !(negative ? axes_[axis].blockedNegative : axes_[axis].blockedPositive);
}

void Axes::startMotion(uint32_t axis, bool negative) {
  axes_[axis].moving = true;
  axes_[axis].negative = negative;
}

void Axes::move(uint32_t axis, int64_t delta) {
  if (delta == 0) return;
  Axis& a = axes_[axis];
  a.commanded += delta;
  a.relative += delta;
  if (locked_) return;
  a.machine += delta;
  a.atReference = {};
}

bool Axes::moveTowards(uint32_t axis, int64_t target, double units) {
  Axis& a = axes_[axis];
  const int64_t distance = target - a.commanded;
  if (distance != 0) {
    startMotion(axis, distance < 0);
    if (!mayMove(axis, distance < 0)) return false;
    const double want = a.rest + units;
    int64_t step = static_cast<int64_t>(std::floor(want));
    a.rest = want - static_cast<double>(step);
    step = std::min<int64_t>(step, std::llabs(distance));
    move(axis, distance < 0 ? -step : step);
  }
  if (a.commanded != target) return false;
  a.moving = false;
  a.rest = 0;
  return true;
}

void Axes::place(uint32_t axis, int64_t machine) {
  Axis& a = axes_[axis];
  a.machine = a.commanded = machine;
  a.rest = 0;
  a.atReference = {};
}

int64_t Axes::reference(const Tables& tables, uint32_t axis, uint32_t point) {
  return point == 1 ? 0 : std::llround(tables.parameterReal(kParamReference2 + point - 2, axis) * kUnitsPerMm);
}

void Axes::arriveAtReference(uint32_t axis, uint32_t point) {
  Axis& a = axes_[axis];
  a.atReference[point - 1] = true;
  if (point == 1) a.referenced = true;
}

void Axes::writeSignals(const nc::gsk::SignalsIo& io, const Tables& tables, bool rapid) const {
  io.setF(2, 1, rapid); // RPDO l.5595
  for (uint32_t i = 0; i < kAxes; ++i) {
    const Axis& a = axes_[i];
    for (uint32_t point = 0; point < 4; ++point) io.setF(94 + 2 * point, i, a.atReference[point]); // l.5028, 5099
    io.setF(102, i, a.moving);                                                                     // MV l.4114
    io.setF(106, i, a.negative);                                                                   // MVD l.4144
    io.setF(120, i, a.referenced);                                                                 // ZRF l.5058
    io.setF(124, i, a.blockedPositive);
    io.setF(126, i, a.blockedNegative);
  }
  const bool valid = tables.parameterBit(kParamSwitches, 3); // SWI
  for (uint32_t i = 0; i < 32; ++i) {                        // position switches l.4226
    const int64_t axis = tables.parameter(kParamSwitchAxis + i);
    bool inside = false;
    if (valid && axis >= 1 && axis <= kAxes) {
      const double mm = static_cast<double>(axes_[static_cast<uint32_t>(axis - 1)].machine) / kUnitsPerMm;
      inside = mm <= tables.parameterReal(kParamSwitchHigh + i) && mm >= tables.parameterReal(kParamSwitchLow + i);
    }
    io.setF(70 + i / 8, i % 8, inside);
  }
}

} // namespace rung::sim::gsk
