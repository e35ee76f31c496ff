// Modules to test engines and passes with: random ones, and one for each operation. All pass the verifier (mode Final),
// and every run of their tasks ends by itself, so what engines make of them can be compared byte for byte.
#pragma once
#include <cstdint>
#include <span>

#include "ir/core/module.h"

namespace rung::ir {

struct RandomOptions {
  uint32_t routines = 3; // at least 1
  uint32_t rungs = 10;   // in a routine, at most
  uint32_t ops = 24;     // in a rung, about
  bool floats = true;
  bool regions = true; // if, loop
  bool jumps = true;   // goto, switch, call, ret, end
  bool host = true;    // messages and services
  bool traps = true;   // rare
  bool known = false;  // rungs store 0 into known cells, load it again, and decide by it: with such a cell forced to 1
                       // what nothing would ever do comes back
};

inline constexpr SpaceId kKnownSpace{2};
inline constexpr uint32_t kKnownCells = 8; // bits of its first byte

// The same seed and options give the same module on every machine.
Module randomModule(uint64_t seed, const RandomOptions& options = {});

// A module whose main task does this operation with boundary values, for every type that it has, and stores every
// result. Operands come from memory or from constants that nothing folds before the module is optimised. An operation
// that an engine does wrong shows in memory, messages, services, faults or counters after two scans; `note` shows
// nowhere.
Module moduleForOp(OpCode code);

// Values at which operations differ, as the bits of the type.
std::span<const uint64_t> boundaryValues(Type type);
// The same for shift counts, indices and bit numbers.
std::span<const uint64_t> boundaryCounts();

} // namespace rung::ir
