// Chunks whose run would change nothing are left out. A chunk rests when its last run has changed no byte that it may
// write, and since then no byte that it may read or write has changed: then the next run would do the same again,
// nothing. What it may touch is in the program's tables (rung_program::activity); chunks that ask the clock or the
// host, call, or return never rest.
//
// Timers that run do not keep a chunk awake (running_timers.h), nor do bytes that each run changes anew
// (relayed_bytes.h).
//
// Changes are found by comparing with a copy of the memory: all that matters to some chunk where a run begins, whoever
// has written it, and after each chunk that ran what it may have written. So nobody who writes has to say so.
//
// A run in which too much changes continues without looking at changes: every chunk is awake then, and the next run
// begins with a new copy. Where looking costs more than what it leaves out, runs without it follow. The scan thread's.
#pragma once
#include <bit>
#include <cstdint>
#include <span>

#include "rtlib/core/chunk_bits.h"
#include "rtlib/core/relayed_bytes.h"
#include "rtlib/core/running_timers.h"

namespace rung::rt {

inline constexpr uint32_t kActivityLine = 16; // bytes that are compared at once

// The last run of a chunk, where that has changed nothing.
struct Rest {
  uint32_t next = 0;   // the chunk that it gave
  uint32_t weight = 0; // that it has used up
};

// Consecutive lines of the memory block.
struct ActivityStretch {
  uint32_t offset = 0; // in the memory block
  uint32_t size = 0;   // bytes
};

enum ChunkProperty : uint8_t { kMayRest = 1, kHasTimers = 2, kRelays = 4 };

// Of one program; host::ActivityMemory makes it.
struct ActivityTables {
  uint32_t task = 0; // whose runs are looked at
  std::span<const ActivityStretch> stretches;
  std::span<const uint32_t> lineNumbers;  // by line of the memory block: which of those in stretches it is
  std::span<const uint32_t> firstWatcher; // by byte of the lines in stretches, and one more: in `watchers`
  std::span<const ChunkBits> watchers;    // chunks that a change of the byte wakes
  std::span<const uint32_t> firstWritten; // by chunk, and one more: in `writtenLines`
  std::span<const uint32_t> writtenLines; // their offsets: what the chunk may change
  std::span<const uint8_t> properties;    // by chunk: of ChunkProperty
  uint64_t meanWeight = 0;                // of a chunk
  uint64_t mostWaking = 0;                // in the unit of weights: where waking costs more, a run continues without it
  std::span<Rest> rests;                  // by chunk
  std::span<uint64_t> passed; // by chunk and one more, as in ChunkBits: it rests, and the next one follows it
  std::span<uint64_t> turned; // by chunk, likewise: it rests, and another one follows it
  std::span<uint8_t> copy;    // of the memory block; of the lines in stretches
  uint32_t firstOfEntry = 0;  // chunks of the routine that the task begins with
  uint32_t endOfEntry = 0;
  RelayTables relayed;
  TimerTables timers; // of no chunk where the program has none
};

class Activity {
public:
  Activity() = default;
  explicit Activity(const ActivityTables& tables) noexcept
      : tables_(tables), timers_(tables.timers), relayed_(tables.relayed) {
    forget();
  }

  bool of(uint32_t task) const noexcept { return !tables_.rests.empty() && tables_.task == task; }
  // Whether the run that begins is to be looked at. Counts runs.
  bool looks() noexcept;
  // Before the first chunk of a run, and where a part of one begins. `memory` begins with a line.
  void begin(uint8_t* memory) noexcept;
  // False: too much has changed, and the rest of the run is one like any other.
  bool isLooking() const noexcept { return copied_; }
  // The first chunk from this one on that does not rest, or gave another one than the next.
  uint32_t firstAwake(uint32_t chunk) noexcept {
    uint32_t word = chunk / kChunkBits;
    uint64_t awake = ~tables_.passed[word] & (~uint64_t{0} << chunk % kChunkBits);
    while (awake == 0) awake = ~tables_.passed[++word];
    const uint32_t found = word * kChunkBits + static_cast<uint32_t>(std::countr_zero(awake));
    left_ += found - chunk;
    return found;
  }
  // Its last run where it rests, else null.
  const Rest* rest(uint32_t chunk) noexcept {
    const uint32_t word = chunk / kChunkBits;
    if (((tables_.passed[word] | tables_.turned[word]) >> chunk % kChunkBits & 1) == 0) return nullptr;
    ++left_;
    return &tables_.rests[chunk];
  }
  // Before a chunk runs.
  void reach(uint8_t* memory, uint32_t chunk) noexcept;
  // After it, with what it gave and used.
  void ran(uint8_t* memory, uint32_t chunk, uint32_t next, uint32_t weight) noexcept;
  // `completed`: no fault has ended the run.
  void end(uint8_t* memory, bool completed) noexcept;
  // The run ends at a chunk, which has run or not.
  void stop(uint8_t* memory, uint32_t chunk) noexcept;

  // No chunk rests any more: memory or code has been replaced.
  void forget() noexcept;

private:
  template <uint32_t Lines>
  uint32_t takeLines(uint8_t* memory, uint32_t offset, uint32_t end) noexcept;
  void takeLine(uint8_t* memory, uint32_t offset) noexcept;
  void wakeWatchers(uint8_t* memory, uint32_t byte) noexcept;
  void pass(uint32_t chunk) noexcept;
  void wakeChunks(uint8_t* memory, const ChunkBits& chunks) noexcept;
  void wakeAll(uint8_t* memory) noexcept;

  ActivityTables tables_;
  RunningTimers timers_;
  RelayedBytes relayed_;
  uint32_t passed_ = 0;    // chunks of the entry below this one have been passed in this run
  bool copied_ = false;    // the copy is that of the last run; else every chunk is awake
  uint32_t looked_ = 0;    // runs that have been looked at since the one that began with a new copy
  bool learns_ = false;    // this run can only find what rests: it began with a new copy, or timers have come to rest
  uint64_t left_ = 0;      // chunks that this run has left out
  uint64_t comparing_ = 0; // what this run has cost, in the unit of weights
  uint64_t waking_ = 0;
  int64_t gained_ = 0;   // weight that looking has saved, less what it has cost
  uint32_t without_ = 0; // runs that are not looked at, still
  uint32_t pause_ = 0;   // how many there are when looking does not pay
};

} // namespace rung::rt
