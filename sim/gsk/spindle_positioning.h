// Spindle positioning mode of the simulated CNC: entered with M18, left with M23, by the handshake of release and clamp
// (man. l.6954-6995). Motion of the positioned spindle is not simulated.
#pragma once
#include <cstdint>

#include "rtlib/nc/control/gsk/signals_io.h"

namespace rung::sim::gsk {

class SpindlePositioning {
public:
  void step(const nc::gsk::SignalsIo& io);
  void reset() { phase_ = Phase::Rotating; }
  // The speed command is cut off.
  bool active() const { return positioning_; }

private:
  enum class Phase : uint8_t {
    Rotating,
    StopTaken, // SPSTP is to fall
    Release,   // SUCLP until *SUCPF = 0
    Released,  // *SUCPF is to rise
    Orient,
    Clamp,   // SCLP until *SCPF = 0
    Clamped, // *SCPF is to rise
    Positioned,
    LeaveRelease,
    LeaveReleased,
  };
  void advance(const nc::gsk::SignalsIo& io);

  Phase phase_ = Phase::Rotating;
  bool positioning_ = false;
  uint32_t orienting_ = 0;
};

} // namespace rung::sim::gsk
