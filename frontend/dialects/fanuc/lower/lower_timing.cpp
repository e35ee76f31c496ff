// Timers, counters and edges: where their presets and values are (inventory §6.2, §6.3, §6.9).
#include <string>

#include "frontend/dialects/fanuc/config.h"
#include "frontend/dialects/fanuc/lower/lower.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::fanuc {
namespace {

using ir::Type;
using ir::ValueId;

constexpr int64_t kUsPerMs = 1000;

// The preset of a variable timer, whose unit depends on the code of its accuracy; another code counts as 0.
network::Preset pagePreset(Lowering& f, uint64_t number) {
  const int64_t usual = timerUnitMs(number) * kUsPerMs;
  network::Preset preset{.word = timerPreset(number), .code = {}, .units = {usual}};
  const network::Address accuracy{areas::kT, static_cast<uint32_t>(kAccuracies + 2 * (number - 1))};
  if (f.room(accuracy) < 2) return preset; // types without accuracies
  preset.code = accuracy;
  preset.units = {usual, 1 * kUsPerMs, 10 * kUsPerMs, 100 * kUsPerMs, 1000 * kUsPerMs, 60'000 * kUsPerMs};
  return preset;
}

// The preset of TMRB and TMRBF: up to PMC-SB7 the remainder of 8 ms is dropped.
network::Preset fixedPreset(Lowering& f) {
  const int64_t ms = f.param(1).value;
  const bool precise = limitsOf(pmcOf(f.language())).hasMilliseconds;
  return {.word = {}, .code = {}, .us = (precise ? ms : ms / 8 * 8) * kUsPerMs};
}

network::Preset presetOf(Lowering& f) {
  constexpr int64_t kAccuracyMs[] = {8, 48, 1000, 10'000, 60'000, 1, 10, 100}; // of TMRC
  const int64_t first = f.param(0).value;
  switch (f.variant()) {
  case kTimerPage: return pagePreset(f, static_cast<uint64_t>(first));
  case kTimerMemory:
    return {.word = network::Address(f.param(1).address), .code = {}, .units = {kAccuracyMs[first] * kUsPerMs}};
  default: return fixedPreset(f);
  }
}

} // namespace

void lowerTimer(Lowering& f) { network::onDelay(f, presetOf(f)); }

void lowerOffDelay(Lowering& f) { network::offDelay(f, fixedPreset(f)); }

void lowerCounter(Lowering& f) {
  const auto number = static_cast<uint64_t>(f.param(0).value);
  const auto load = [&](network::Address address) { return [&f, address] { return f.load(Type::I16, address); }; };
  switch (f.variant()) {
  case kCounterPage:
    return network::ringCounter(f, {.preset = load(counterPreset(number)), .value = counterValue(number)});
  case kCounterFixed:
    return network::ringCounter(f, {.preset = [&] { return f.b.constant(Type::I16, f.param(1).value); },
                                    .value = {areas::kC, static_cast<uint32_t>(kFixedCounters + 2 * (number - 1))}});
  default:
    return network::ringCounter(f,
                                {.preset = load(f.param(0).address), .value = f.param(1).address, .keepsEdge = true});
  }
}

// Instructions with the same number share their memory; number 0 is one of its own.
void lowerEdge(Lowering& f) {
  const int64_t number = f.param(0).value;
  const ir::SlotId memory =
      number == 0 ? f.slot("edge", Type::Bit) : f.shared("@edge/" + std::to_string(number), Type::Bit);
  f.setOutput(frontend::pulse(f.b, memory, f.act(), f.variant()));
}

} // namespace rung::frontend::fanuc
