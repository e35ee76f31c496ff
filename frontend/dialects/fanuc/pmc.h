// The types of the PMC, which differ in their memory (inventory §3.3; F11).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "frontend/network/address.h"

namespace rung::frontend::fanuc {

// The columns of the table of ranges.
enum class Pmc : uint8_t { Sa1, Sa3, Sb7, MemA, MemB, MemC, MemD };
inline constexpr size_t kPmcCount = 7;

// The type that a file or `config pmc` names: "0i-F PMC(MEM-B,FLT)", "PMC-SB7", "30i-B PMC(MEM-C,FB,FLT)". Nothing: not
// known. Safety PMCs (DCS) have the ranges of MEM-B.
std::optional<Pmc> pmcNamed(std::string_view text);

// What differs beside the areas.
struct PmcLimits {
  uint32_t timers = 0; // fixed ones: TMRB, TMRBF
  uint32_t edges = 0;
  uint32_t subprograms = 0;
  bool hasMilliseconds = true; // fixed timers count in 1 ms, otherwise in 8 ms
  constexpr int64_t mostPresetMs() const { return hasMilliseconds ? 32'760'000 : 262'136; } // of fixed timers
  bool hasEnd = true; // the program has subprograms, and END after them
};
const PmcLimits& limitsOf(Pmc pmc);

} // namespace rung::frontend::fanuc
