// The spindles of the simulated CNC: speed command, override, enabling, gears, orientation (man. chapter VIII). The
// direction and the stop of M3, M4, M5 are the PLC's: SGN and *SSTP.
#pragma once
#include <cstdint>

#include "rtlib/nc/control/gsk/signals_io.h"
#include "sim/gsk/tables.h"

namespace rung::sim::gsk {

class Spindle {
public:
  void command(uint32_t speed) { commanded_ = speed; }
  // `positioning`: the speed command is cut off.
  void step(const nc::gsk::SignalsIo& io, const Tables& tables, bool positioning);
  void reset() { commanded_ = 0; }
  uint32_t commanded() const { return commanded_; }
  double actual() const { return one_.actual; } // signed, r/min
  double actual2() const { return two_.actual; }

private:
  struct Motor {
    double actual = 0;
    uint32_t orienting = 0; // slots at standstill with ORCM
    void step(double target);
    void orient(bool ordered);
    bool oriented() const;
  };
  double firstTarget(const nc::gsk::SignalsIo& io, const Tables& tables) const;
  void writeGear(const nc::gsk::SignalsIo& io, const Tables& tables) const;

  uint32_t commanded_ = 0; // by S
  Motor one_;
  Motor two_;
};

} // namespace rung::sim::gsk
