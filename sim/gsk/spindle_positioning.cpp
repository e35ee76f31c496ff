// Spindle positioning (see spindle_positioning.h).
#include "sim/gsk/spindle_positioning.h"

namespace rung::sim::gsk {
namespace {

constexpr uint32_t kEnter = 18, kLeave = 23;
constexpr uint32_t kOrientingSlots = 12;

bool commanded(const nc::gsk::SignalsIo& io, uint32_t code) { return io.f(7, 0) && io.fDword(10) == code; }

} // namespace

void SpindlePositioning::step(const nc::gsk::SignalsIo& io) {
  advance(io);
  positioning_ = phase_ != Phase::Rotating && phase_ != Phase::LeaveReleased;
  io.setF(39, 0, positioning_);                                              // MSPOS
  io.setF(38, 1, phase_ == Phase::Release || phase_ == Phase::LeaveRelease); // SUCLP
  io.setF(38, 0, phase_ == Phase::Clamp);                                    // SCLP
}

void SpindlePositioning::advance(const nc::gsk::SignalsIo& io) {
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

} // namespace rung::sim::gsk
