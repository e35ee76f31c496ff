// The ways in which programs run on a machine, each under a guard: what it does in real time is guarded, what it does
// before, after and between is not.
#pragma once
#include <cstdint>
#include <string>

#include "machine/host/mapping_file.h"
#include "rung/program.h"

namespace rung::test {

// What one run has shown.
struct Outcome {
  std::string problem; // "" or what went wrong; the rest counts up to there
  uint64_t slices = 0; // where something was due
  uint64_t messages = 0;
  uint64_t faults = 0; // after each the program is started again
};

// Milliseconds of the program's time that each of the following runs.
constexpr int kRunMs = 10'000;

// In LinuxCNC's component, in a thread of 1 ms, with the pins of the map.
Outcome runInBox(const rung_program& program, host::File map, const std::string& retain);
// The same with the fast task in a place of its own, beside a host that runs everything in one: pins that differ are a
// problem.
Outcome runFastApart(const rung_program& program, const host::File& map);
// Slice by slice beside its control, as a host of its own does it.
Outcome runBare(const rung_program& program, const std::string& retain);
// In the loop on the machine's clock.
Outcome runOnClock(const rung_program& program, const std::string& retain);

// A pin for every bit that a machine could be connected to.
host::File mapOfAll(const rung_program& program);

} // namespace rung::test
