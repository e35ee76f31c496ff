// The configuration that the compiler reads: the period or the steps of a slot (P3), and the presets of the timer and
// counter pages (§18).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/gsk/areas.h"
#include "frontend/dialects/gsk/read/signals.h"

namespace rung::frontend::gsk {

// In every slot Level 1 runs, followed by one part of Level 2 (P3).
inline constexpr uint32_t kSlotUs = 8000;

// A preset that the operator entered, as the control stores it.
struct Preset {
  network::Address address;
  uint32_t value = 0; // 16 bits
};

// Reports values that the control would not accept. The other functions take a checked configuration.
void checkConfig(const frontend::CompileOptions& options, Diagnostics& diagnostics);
// n of P3, if the period is given.
std::optional<uint32_t> partsOf(const frontend::CompileOptions& options);
// The number of steps in one slot of 8 ms, including Level 1, if given: n follows (man. l.434-444).
std::optional<uint32_t> slotStepsOf(const frontend::CompileOptions& options);
// Machine::Any if it is not given, or wrong and reported.
Machine configuredMachine(const frontend::CompileOptions& options, Diagnostics& diagnostics);
std::vector<Preset> presetsOf(const frontend::CompileOptions& options);

// Timers 1-20 count in 48 ms, the others in 8 ms (man. l.1114).
constexpr uint32_t timerUnitMs(int64_t number) { return number <= 20 ? 48 : 8; }
// The places of a timer's preset, and of a counter's preset and value (P8, P9).
constexpr network::Address timerPreset(int64_t number) { return {areas::kT, static_cast<uint32_t>(2 * (number - 1))}; }
constexpr network::Address counterPreset(int64_t number) {
  return {areas::kC, static_cast<uint32_t>(4 * (number - 1))};
}
constexpr network::Address counterValue(int64_t number) {
  return {areas::kC, static_cast<uint32_t>(4 * (number - 1) + 2)};
}

} // namespace rung::frontend::gsk
