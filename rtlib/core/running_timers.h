// Timers of chunks that rest (see activity.h): the numbers that a resting chunk would move on in each run are moved on
// here (rung_timer), so that memory is the same after every run as if the chunk ran.
//
// A chunk rests with moving numbers once two runs, between which nothing else has changed, have changed the same
// numbers by their amounts and nothing else. The first run alone would not do: a number may happen to change by the
// amount where the chunk stores something else. It is woken before the run in which one of them comes to its limit.
#pragma once
#include <bit>
#include <cstdint>
#include <span>

#include "rtlib/core/chunk_bits.h"
#include "rung/program.h"

namespace rung::rt {

// A number that is moved on.
struct MovingNumber {
  uint32_t cell = 0; // offset in the memory block
  uint32_t size = 0; // bytes
  int64_t amount = 0;
};

struct ChunkTimers {
  uint64_t moved = 0; // by its last run: a bit for each of its rung_timer
  uint32_t count = 0; // of its numbers that are moved on; from its timer_first in `numbers`
  uint32_t runs = 0;  // in which they may be, still
};

// Of one program; host::ActivityMemory makes it.
struct TimerTables {
  std::span<const rung_activity> chunks;
  std::span<const rung_timer> timers;
  std::span<MovingNumber> numbers; // by timer
  std::span<ChunkTimers> states;   // by chunk
  std::span<uint64_t> onlyMoved;   // a bit by chunk, as in ChunkBits: its last run has moved numbers on, nothing else
  std::span<uint64_t> moving;      // likewise: it rests, and its numbers are moved on
  std::span<uint64_t> starting;    // likewise: from the end of this run on
};

class RunningTimers {
public:
  RunningTimers() = default;
  explicit RunningTimers(const TimerTables& tables) noexcept : tables_(tables) {}

  // After a chunk that ran: takes numbers that it has moved on from the memory into the copy. Gives which, a bit for
  // each of its timers.
  uint64_t take(const uint8_t* memory, uint8_t* copy, uint32_t chunk) const noexcept;
  // It has changed nothing but those. Whether it may rest.
  bool settle(const uint8_t* memory, uint32_t chunk, uint64_t moved) noexcept;

  // These chunks are awake. This run has passed by those below `passed`: their numbers are moved on.
  void wake(uint8_t* memory, uint8_t* copy, const ChunkBits& chunks, uint32_t passed) noexcept {
    tables_.onlyMoved[chunks.word] &= ~chunks.bits;
    tables_.starting[chunks.word] &= ~chunks.bits;
    const uint64_t stopped = tables_.moving[chunks.word] & chunks.bits;
    if (stopped != 0) stop(memory, copy, {chunks.word, stopped}, passed);
  }
  void wakeAll(uint8_t* memory, uint8_t* copy, uint32_t passed) noexcept;
  void forget() noexcept;

  // Moves on what rests below `end`. Calls `wake` with the ChunkBits of each chunk that is to run in the next run.
  // Gives how many numbers it has moved on.
  template <class Wake>
  uint64_t end(uint8_t* memory, uint8_t* copy, uint32_t end, const Wake& wake) noexcept {
    uint64_t count = 0;
    for (uint32_t word = 0; word < tables_.moving.size(); ++word) {
      for (uint64_t left = tables_.moving[word]; left != 0; left &= left - 1) {
        const uint32_t chunk = word * kChunkBits + static_cast<uint32_t>(std::countr_zero(left));
        if (chunk >= end) return count;
        move(memory, copy, chunk);
        count += tables_.states[chunk].count;
        if (--tables_.states[chunk].runs != 0) continue;
        const uint64_t bit = left & -left;
        tables_.moving[word] &= ~bit;
        wake(ChunkBits{word, bit});
      }
      tables_.moving[word] |= tables_.starting[word];
      tables_.starting[word] = 0;
    }
    return count;
  }

private:
  void stop(uint8_t* memory, uint8_t* copy, const ChunkBits& chunks, uint32_t passed) noexcept;
  void move(uint8_t* memory, uint8_t* copy, uint32_t chunk) const noexcept;

  TimerTables tables_;
};

} // namespace rung::rt
