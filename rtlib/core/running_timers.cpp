// Moving numbers on (see running_timers.h).
#include "rtlib/core/running_timers.h"

#include <algorithm>
#include <cstring>

namespace rung::rt {
namespace {

template <class T>
T load(const uint8_t* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

int64_t numberAt(const uint8_t* at, uint32_t size) noexcept {
  return size == sizeof(int32_t) ? load<int32_t>(at) : load<int64_t>(at);
}

template <class T>
void add(uint8_t* memory, uint8_t* copy, const MovingNumber& number) noexcept {
  const T value = static_cast<T>(load<T>(memory + number.cell) + static_cast<T>(number.amount));
  std::memcpy(memory + number.cell, &value, sizeof value);
  std::memcpy(copy + number.cell, &value, sizeof value);
}

// In how many runs from now on the number stays below its limit, or beyond it. It and the amount are not negative.
int64_t runsBefore(const rung_timer& timer, const uint8_t* memory, int64_t number, int64_t amount) noexcept {
  if (timer.down != 0) return (number - 1) / amount;
  const int64_t limit =
      timer.limit * (timer.limit_cell == RUNG_NONE ? 1 : int64_t{load<uint16_t>(memory + timer.limit_cell)});
  return number >= limit ? INT64_MAX : (limit - 1 - number) / amount;
}

} // namespace

uint64_t RunningTimers::take(const uint8_t* memory, uint8_t* copy, uint32_t chunk) const noexcept {
  const rung_activity& activity = tables_.chunks[chunk];
  uint64_t moved = 0;
  for (uint32_t i = 0; i < activity.timer_count; ++i) {
    const rung_timer& timer = tables_.timers[activity.timer_first + i];
    const int64_t now = numberAt(memory + timer.cell, timer.size);
    const int64_t before = numberAt(copy + timer.cell, timer.size);
    const int64_t amount = numberAt(memory + timer.amount, timer.size);
    if (now < 0 || before < 0 || amount <= 0 || (timer.down != 0 ? before - now : now - before) != amount) continue;
    std::memcpy(copy + timer.cell, memory + timer.cell, timer.size);
    moved |= uint64_t{1} << i;
  }
  return moved;
}

bool RunningTimers::settle(const uint8_t* memory, uint32_t chunk, uint64_t moved) noexcept {
  ChunkTimers& state = tables_.states[chunk];
  const auto [word, bit] = bitOf(chunk);
  uint64_t& onlyMoved = tables_.onlyMoved[word];
  const bool again = (onlyMoved & bit) != 0 && state.moved == moved;
  state.moved = moved;
  onlyMoved |= bit;
  if (moved == 0) return true;
  if (!again) return false;
  const rung_activity& activity = tables_.chunks[chunk];
  int64_t runs = UINT32_MAX;
  uint32_t count = 0;
  for (uint64_t left = moved; left != 0; left &= left - 1) {
    const rung_timer& timer = tables_.timers[activity.timer_first + static_cast<uint32_t>(std::countr_zero(left))];
    const int64_t amount = numberAt(memory + timer.amount, timer.size);
    runs = std::min(runs, runsBefore(timer, memory, numberAt(memory + timer.cell, timer.size), amount));
    tables_.numbers[activity.timer_first + count++] = {timer.cell, timer.size, timer.down != 0 ? -amount : amount};
  }
  if (runs <= 0) return false;
  state.count = count;
  state.runs = static_cast<uint32_t>(runs);
  tables_.starting[word] |= bit;
  return true;
}

void RunningTimers::move(uint8_t* memory, uint8_t* copy, uint32_t chunk) const noexcept {
  for (const MovingNumber& number :
       tables_.numbers.subspan(tables_.chunks[chunk].timer_first, tables_.states[chunk].count))
    if (number.size == sizeof(int32_t))
      add<int32_t>(memory, copy, number);
    else
      add<int64_t>(memory, copy, number);
}

void RunningTimers::stop(uint8_t* memory, uint8_t* copy, const ChunkBits& chunks, uint32_t passed) noexcept {
  tables_.moving[chunks.word] &= ~chunks.bits;
  for (uint64_t left = chunks.bits; left != 0; left &= left - 1) {
    const uint32_t chunk = chunks.word * kChunkBits + static_cast<uint32_t>(std::countr_zero(left));
    if (chunk < passed) move(memory, copy, chunk);
  }
}

void RunningTimers::wakeAll(uint8_t* memory, uint8_t* copy, uint32_t passed) noexcept {
  for (uint32_t word = 0; word < tables_.moving.size(); ++word) wake(memory, copy, {word, ~uint64_t{0}}, passed);
}

void RunningTimers::forget() noexcept {
  std::ranges::fill(tables_.onlyMoved, 0);
  std::ranges::fill(tables_.moving, 0);
  std::ranges::fill(tables_.starting, 0);
}

} // namespace rung::rt
