// The configuration of GSK's control: the machine, and its timer and counter pages (§18).
#pragma once
#include <cstdint>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/gsk/areas.h"
#include "frontend/dialects/gsk/read/signals.h"
#include "frontend/network/lower/configuration.h"

namespace rung::frontend::gsk {

// Machine::Any if it is not given, or wrong and reported.
Machine configuredMachine(const frontend::CompileOptions& options, Diagnostics& diagnostics);

// Timers 1-20 count in 48 ms, the others in 8 ms (man. l.1114).
constexpr uint32_t timerUnitMs(uint64_t number) { return number <= 20 ? 48 : 8; }
// The places of a timer's preset, and of a counter's preset and value (P8, P9).
constexpr network::Address timerPreset(uint64_t number) { return {areas::kT, static_cast<uint32_t>(2 * (number - 1))}; }
constexpr network::Address counterPreset(uint64_t number) {
  return {areas::kC, static_cast<uint32_t>(4 * (number - 1))};
}
constexpr network::Address counterValue(uint64_t number) {
  return {areas::kC, static_cast<uint32_t>(4 * (number - 1) + 2)};
}

inline constexpr network::PresetPages kPages{.timers = 100,
                                             .counters = 100,
                                             .mostTimer = 65535,
                                             .mostCounter = 65535,
                                             .timerUnitMs = timerUnitMs,
                                             .timerPreset = timerPreset,
                                             .counterPreset = counterPreset};

} // namespace rung::frontend::gsk
