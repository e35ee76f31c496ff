// The spindles of the simulated CNC: speed command, override, enabling, gears, orientation (GSK's man. chapter VIII).
// Direction and stop for M3, M4, M5 are controlled by the PLC (Cnc::spindle).
#pragma once
#include <cstdint>

#include "rtlib/nc/control/pmc/signals_io.h"
#include "sim/pmc/tables.h"

namespace rung::sim::pmc {

class Spindle {
public:
  void command(uint32_t speed) { commanded_ = speed; }
  // `positioning`: the speed command is cut off.
  void step(const Cnc& cnc, const nc::pmc::SignalsIo& io, const Tables& tables, bool positioning);
  void reset() { commanded_ = 0; }
  uint32_t commanded() const { return commanded_; }
  double actual() const { return one_.actual; } // signed, r/min
  double actual2() const { return two_.actual; }

  template <class Archive>
  void state(Archive& archive) {
    archive(commanded_, one_, two_);
  }

private:
  struct Motor {
    double actual = 0;
    uint32_t orienting = 0; // slots at standstill with ORCM
    void step(double target);
    void orient(bool ordered);
    bool oriented() const;
    template <class Archive>
    void state(Archive& archive) {
      archive(actual, orienting);
    }
  };
  double firstTarget(const Cnc& cnc, const nc::pmc::SignalsIo& io, const Tables& tables) const;
  void writeGear(const Cnc& cnc, const nc::pmc::SignalsIo& io, const Tables& tables) const;

  uint32_t commanded_ = 0; // by the S code
  Motor one_;
  Motor two_;
};

// Spindle positioning mode of the simulated CNC: entered with M18, left with M23, with the handshake of release and
// clamp (man. l.6954-6995). Motion of the positioned spindle is not simulated.

class SpindlePositioning {
public:
  void step(const nc::pmc::SignalsIo& io);
  void reset() { phase_ = Phase::Rotating; }
  // The speed command is cut off.
  bool active() const { return positioning_; }

  template <class Archive>
  void state(Archive& archive) {
    archive(phase_, positioning_, orienting_);
  }

private:
  enum class Phase : uint8_t {
    Rotating,
    StopTaken, // waits for SPSTP to fall
    Release,   // SUCLP until *SUCPF = 0
    Released,  // waits for *SUCPF to rise
    Orient,
    Clamp,   // SCLP until *SCPF = 0
    Clamped, // waits for *SCPF to rise
    Positioned,
    LeaveRelease,
    LeaveReleased,
  };
  void advance(const nc::pmc::SignalsIo& io);

  Phase phase_ = Phase::Rotating;
  bool positioning_ = false;
  uint32_t orienting_ = 0;
};

} // namespace rung::sim::pmc
