// Axes of the simulated CNC (see axes.h).
#include "sim/gsk/axes.h"

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
  const auto show = [&](uint32_t byte, auto is) {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kAxes; ++i) bits |= uint32_t{is(axes_[i])} << i;
    io.setFByte(byte, static_cast<uint8_t>(bits));
  };
  for (uint32_t point = 0; point < 4; ++point) // l.5028, 5099
    show(94 + 2 * point, [&](const Axis& axis) { return axis.atReference[point]; });
  show(102, [](const Axis& axis) { return axis.moving; });     // MV l.4114
  show(106, [](const Axis& axis) { return axis.negative; });   // MVD l.4144
  show(120, [](const Axis& axis) { return axis.referenced; }); // ZRF l.5058
  show(124, [](const Axis& axis) { return axis.blockedPositive; });
  show(126, [](const Axis& axis) { return axis.blockedNegative; });
  io.setFDword(70, switches(tables));
}

// Position switches, a bit each (l.4226).
uint32_t Axes::switches(const Tables& tables) const {
  if (!tables.parameterBit(kParamSwitches, 3)) return 0; // SWI
  uint32_t bits = 0;
  for (uint32_t i = 0; i < 32; ++i) {
    const int64_t axis = tables.parameter(kParamSwitchAxis + i);
    if (axis < 1 || axis > kAxes) continue;
    const double mm = static_cast<double>(axes_[static_cast<uint32_t>(axis - 1)].machine) / kUnitsPerMm;
    const bool inside =
        mm <= tables.parameterReal(kParamSwitchHigh + i) && mm >= tables.parameterReal(kParamSwitchLow + i);
    bits |= uint32_t{inside} << i;
  }
  return bits;
}

} // namespace rung::sim::gsk
