// The simulated CNC beside a program of the PMC family, by the table of its dialect.
#pragma once
#include <memory>

#include "sim/pmc/cnc.h"
#include "sim/simulated_nc.h"

namespace rung::sim::pmc {

// The table outlives it.
std::unique_ptr<SimulatedNc> makeSimulatedPmc(const Cnc& cnc);

} // namespace rung::sim::pmc
