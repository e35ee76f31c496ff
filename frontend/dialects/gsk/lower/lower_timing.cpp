// Timers and counters: where their presets and values are (§7.2, §7.4).
#include "frontend/dialects/gsk/config.h"
#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::gsk {
namespace {

using ir::Type;

network::Preset presetOf(Lowering& f) {
  constexpr int64_t kUsPerMs = 1000;
  constexpr int64_t kAccuracyMs[] = {8, 48, 1000}; // man. l.1199-1202
  const auto word = [](const network::Address& address, int64_t unitMs) {
    return network::Preset{.word = address, .code = {}, .units = {unitMs * kUsPerMs}};
  };
  const auto first = static_cast<uint64_t>(f.param(0).value);
  switch (f.variant()) {
  case kTimerPage: return word(timerPreset(first), timerUnitMs(first));
  case kTimerMemory: return word(f.param(1).address, kAccuracyMs[first]);
  default: return {.word = {}, .code = {}, .us = f.param(1).value / 8 * 8 * kUsPerMs}; // man. l.1152
  }
}

} // namespace

void lowerTimer(Lowering& f) { network::onDelay(f, presetOf(f)); }

// P28: CTRC keeps the edge in bit 0 of register +2.
void lowerCounter(Lowering& f) {
  const bool inMemory = f.variant() == kCounterMemory;
  const network::Address preset =
      inMemory ? f.param(0).address : counterPreset(static_cast<uint64_t>(f.param(0).value));
  network::ringCounter(f, {.preset = [&] { return f.load(Type::I16, preset); },
                           .value = inMemory ? network::Address(f.param(1).address)
                                             : counterValue(static_cast<uint64_t>(f.param(0).value)),
                           .keepsEdge = inMemory});
}

} // namespace rung::frontend::gsk
