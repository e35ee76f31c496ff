// The configuration that compilers of this family read: the period or the steps of a slot (P3), and the presets of the
// timer and counter pages (§18), `tmr.N` in milliseconds and `ctr.N`.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "frontend/network/address.h"
#include "frontend/network/lower/lower_module.h"

namespace rung::frontend::network {

// What the timer and counter pages of a control have.
struct PresetPages {
  uint64_t timers = 0; // their numbers begin with 1
  uint64_t counters = 0;
  uint64_t mostTimer = 0; // as the control stores a preset, in units of the timer
  uint64_t mostCounter = 0;
  uint32_t (*timerUnitMs)(uint64_t number) = nullptr;
  Address (*timerPreset)(uint64_t number) = nullptr;
  Address (*counterPreset)(uint64_t number) = nullptr;
};

// Reports values that the control would not accept. The other functions take a checked configuration.
void checkConfig(const frontend::CompileOptions& options, const PresetPages& pages, std::span<const nc::ConfigKey> keys,
                 Diagnostics& diagnostics);
// Stores the presets that are configured.
void addPresets(ModuleLowering& lowering, const frontend::CompileOptions& options, const PresetPages& pages);
// n of P3: from the period, or from the steps of a slot; with both the period counts and must suffice.
uint32_t partsOfLevel2(ModuleLowering& lowering, const frontend::CompileOptions& options, Diagnostics& diagnostics);

} // namespace rung::frontend::network
