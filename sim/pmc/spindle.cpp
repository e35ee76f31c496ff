// The spindles of the simulated CNC.
#include "sim/pmc/spindle.h"

#include <algorithm>
#include <cmath>

namespace rung::sim::pmc {

namespace {

constexpr double kRampPerSlot = 60;      // r/min
constexpr uint32_t kOrientingSlots = 12; // about 100 ms

double plcSpeed(const Cnc& cnc, const nc::pmc::SignalsIo& io, const Tables& tables, uint32_t word) {
  return tables.parameterReal(cnc.parameters.maxSpindle) * (io.gWord(word) & 0xFFF) / cnc.spindleSteps;
}

} // namespace

void Spindle::Motor::step(double target) {
  const double difference = target - actual;
  actual = std::fabs(difference) <= kRampPerSlot ? target : actual + std::copysign(kRampPerSlot, difference);
}

void Spindle::Motor::orient(bool ordered) {
  orienting = ordered && actual == 0 ? std::min(orienting + 1, kOrientingSlots) : 0;
}

bool Spindle::Motor::oriented() const { return orienting == kOrientingSlots; }

// The unsigned target speed of the first spindle, in order of precedence: gear shift, PLC, S code with override;
// limited by the present gear.
double Spindle::firstTarget(const Cnc& cnc, const nc::pmc::SignalsIo& io, const Tables& tables) const {
  if (io.g(29, 5)) return tables.parameterReal(cnc.parameters.gearSpeed); // SOR l.6406
  if (io.g(33, 7)) return plcSpeed(cnc, io, tables, 32);                  // SSND l.7369
  double speed = commanded_ * (io.gByte(30) / 100.0);                     // SOV l.6290
  if (tables.parameterBit(cnc.parameters.gearsOfT)) {
    const uint32_t gear = (io.gByte(28) >> 1) & 3; // l.6434
    const double most = tables.parameterReal(cnc.parameters.gearMax + gear);
    if (most > 0) speed = std::min(speed, most);
  }
  const double most = tables.parameterReal(cnc.parameters.maxSpindle);
  return most > 0 ? std::min(speed, most) : speed;
}

// Writes GR1O-GR4O by the switching speeds (l.6377-6388); without these there are no gears.
void Spindle::writeGear(const Cnc& cnc, const nc::pmc::SignalsIo& io, const Tables& tables) const {
  uint32_t gear = 0;
  bool shifts = false;
  for (uint32_t i = 0; i + 1 < cnc.gears; ++i) {
    const double border = tables.parameterReal(cnc.parameters.gearSwitch + i);
    shifts = shifts || border > 0;
    if (border > 0 && commanded_ > border) gear = i + 1;
  }
  for (uint32_t i = 0; i < cnc.gears; ++i)
    io.setF(34, i, shifts && !tables.parameterBit(cnc.parameters.gearsOfT) && i == gear && commanded_ != 0);
}

void Spindle::step(const Cnc& cnc, const nc::pmc::SignalsIo& io, const Tables& tables, bool positioning) {
  const SpindleOrder first = cnc.spindle(io, 0), second = cnc.spindle(io, 1);
  const bool orient = io.g(70, 6);                               // ORCM l.6451
  const bool enabled = first.enabled && !orient && !positioning; // l.6272
  const double speed = enabled ? firstTarget(cnc, io, tables) : 0;
  const double target = first.negative ? -speed : speed; // l.6294
  one_.step(target);
  one_.orient(orient);
  const double speed2 = second.enabled && !io.g(74, 6) ? plcSpeed(cnc, io, tables, 34) : 0;
  two_.step(second.negative ? -speed2 : speed2);
  two_.orient(io.g(74, 6));

  writeGear(cnc, io, tables);
  io.setF(1, 4, enabled && speed != 0); // ENB l.6314
  io.setF(45, 1, one_.actual == 0);
  io.setF(45, 3, speed != 0 && one_.actual == target); // SAR l.6334
  io.setF(45, 7, one_.oriented());
  io.setF(49, 1, two_.actual == 0);
  io.setF(49, 3, speed2 != 0 && std::fabs(two_.actual) == speed2);
  io.setF(49, 7, two_.oriented());
  io.setFWord(40, static_cast<uint16_t>(std::lround(std::fabs(one_.actual))));
  io.setFWord(202, static_cast<uint16_t>(std::lround(std::fabs(two_.actual))));
}

// Spindle positioning.

namespace {

constexpr uint32_t kEnter = 18, kLeave = 23;

bool commanded(const nc::pmc::SignalsIo& io, uint32_t code) { return io.f(7, 0) && io.fDword(10) == code; }

} // namespace

void SpindlePositioning::step(const nc::pmc::SignalsIo& io) {
  advance(io);
  positioning_ = phase_ != Phase::Rotating && phase_ != Phase::LeaveReleased;
  io.setF(39, 0, positioning_);                                              // MSPOS
  io.setF(38, 1, phase_ == Phase::Release || phase_ == Phase::LeaveRelease); // SUCLP
  io.setF(38, 0, phase_ == Phase::Clamp);                                    // SCLP
}

void SpindlePositioning::advance(const nc::pmc::SignalsIo& io) {
  const bool stopped = io.g(28, 6);   // SPSTP
  const bool released = !io.g(28, 4); // *SUCPF
  const bool clamped = !io.g(28, 5);  // *SCPF
  switch (phase_) {
  case Phase::Rotating:
    if (commanded(io, kEnter) && stopped) phase_ = Phase::StopTaken;
    return;
  case Phase::StopTaken:
    if (!stopped) phase_ = Phase::Release;
    return;
  case Phase::Release:
    if (released) phase_ = Phase::Released;
    return;
  case Phase::Released:
    orienting_ = kOrientingSlots;
    if (!released) phase_ = Phase::Orient;
    return;
  case Phase::Orient:
    if (--orienting_ == 0) phase_ = Phase::Clamp;
    return;
  case Phase::Clamp:
    if (clamped) phase_ = Phase::Clamped;
    return;
  case Phase::Clamped:
    if (!clamped) phase_ = Phase::Positioned;
    return;
  case Phase::Positioned:
    if (commanded(io, kLeave) && stopped) phase_ = Phase::LeaveRelease;
    return;
  case Phase::LeaveRelease:
    if (released) phase_ = Phase::LeaveReleased;
    return;
  case Phase::LeaveReleased:
    if (!released) phase_ = Phase::Rotating;
    return;
  }
}

} // namespace rung::sim::pmc
