// The configuration of FANUC's control: the type of the PMC, and its timer and counter pages.
#pragma once
#include <cstdint>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/fanuc/areas.h"
#include "frontend/dialects/fanuc/read/mnemonic.h"
#include "frontend/network/lower/configuration.h"

namespace rung::frontend::fanuc {

// The type of `config pmc`, otherwise that which a section %@0 names, otherwise MEM-B (F11). A type that is not known
// is reported.
Pmc configuredPmc(const frontend::CompileOptions& options, const SourceManager& sources, const MnemonicFiles& files,
                  Diagnostics& diagnostics);

// Timers 1-8 count in 48 ms, the others in 8 ms (§6.2).
constexpr uint32_t timerUnitMs(uint64_t number) { return number <= 8 ? 48 : 8; }
// The places of a timer's preset, and of a counter's preset and value.
constexpr network::Address timerPreset(uint64_t number) { return {areas::kT, static_cast<uint32_t>(2 * (number - 1))}; }
constexpr network::Address counterPreset(uint64_t number) {
  return {areas::kC, static_cast<uint32_t>(4 * (number - 1))};
}
constexpr network::Address counterValue(uint64_t number) {
  return {areas::kC, static_cast<uint32_t>(4 * (number - 1) + 2)};
}

// As many as the type's areas hold.
network::PresetPages pagesOf(Pmc pmc);

} // namespace rung::frontend::fanuc
