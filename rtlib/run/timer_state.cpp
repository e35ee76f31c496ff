// See timer_state.h.
#include "rtlib/run/timer_state.h"

#include <algorithm>
#include <cstring>

#include "rung/types.hpp"

namespace rung::runtime {
namespace {

uint64_t cellOf(const core::Memory& memory, uint32_t type, uint32_t space, uint32_t at) noexcept {
  const uint32_t bits = elementBits(type);
  if (space != RUNG_NONE) return memory.read(space, at, bits / 8);
  uint64_t value = 0;
  std::memcpy(&value, memory.block() + at, bits / 8);
  return value;
}

int64_t signedOf(uint64_t raw, uint32_t type) noexcept {
  const uint32_t unused = 64 - elementBits(type);
  return static_cast<int64_t>(raw << unused) >> unused;
}

// Without overflow: both are not negative.
int64_t product(int64_t a, int64_t b) noexcept { return a == 0 || b <= INT64_MAX / a ? a * b : INT64_MAX; }

int64_t presetOf(const core::Memory& memory, const rung_timer& timer) noexcept {
  const int64_t units =
      timer.preset_type == 0
          ? timer.preset
          : static_cast<int64_t>(cellOf(memory, timer.preset_type, timer.preset_space, timer.preset_at) & INT64_MAX);
  if (units < 0) return -1;
  uint64_t unit = timer.unit_type == 0 ? 0 : cellOf(memory, timer.unit_type, timer.unit_space, timer.unit_at);
  if (unit >= timer.unit_count) unit = 0;
  return product(units, timer.units[unit]);
}

} // namespace

// Its time is signed where it may be negative: a time of 64 bits, and one that falls.
TimerState stateOf(const core::Memory& memory, const rung_timer& timer) noexcept {
  TimerState state{.preset = presetOf(memory, timer)};
  const bool falls = (timer.flags & RUNG_TIMER_DOWN) != 0;
  const uint64_t raw = cellOf(memory, timer.time_type, timer.time_space, timer.time_at);
  const int64_t units =
      falls || timer.time_type == RUNG_TYPE_I64 ? signedOf(raw, timer.time_type) : static_cast<int64_t>(raw);
  const int64_t time = units < 0 ? -1 : product(units, timer.time_us);
  const bool isOn = timer.running_at == RUNG_NONE || memory.block()[timer.running_at] != 0;
  state.running = isOn && time > 0 && (falls || state.preset < 0 || time < state.preset);
  if (!state.running) return state;
  const int64_t rest = state.preset < 0 ? -1 : std::max<int64_t>(state.preset - time, 0);
  state.elapsed = falls ? rest : time;
  state.remaining = falls ? time : rest;
  return state;
}

} // namespace rung::runtime
