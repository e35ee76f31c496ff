// What the simulated CNC knows when it answers a window request (Cnc::answer).
#pragma once
#include "sim/pmc/machine.h"
#include "sim/pmc/operation.h"

namespace rung::sim::pmc {

struct Window {
  Machine& machine;
  const Operation& operation;
  const nc::pmc::SignalsIo& io;
  bool locked;    // tables are protected
  uint64_t slots; // since the power-on
};

} // namespace rung::sim::pmc
