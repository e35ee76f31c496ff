// Chunks whose run would change nothing are left out. A chunk rests when its last run has changed no byte that it may
// write, and since then no byte that it may read or write has changed: then the next run would do the same again,
// nothing. What it may touch is in the program's tables (rung_program::activity); chunks that ask the clock or the
// host, call, or return never rest.
//
// Changes are found by comparing with a copy of the memory: all that matters to some chunk where a run begins, whoever
// has written it, and after each chunk that ran what it may have written. So nobody who writes has to say so.
//
// While most chunks run, comparing does not pay: then runs without it follow, and the next one with it finds all
// changes since. The scan thread's.
#pragma once
#include <cstdint>
#include <span>

namespace rung::rt {

inline constexpr uint32_t kActivityLine = 16; // bytes that are compared at once

// The last run of a chunk, where that has changed nothing.
struct Rest {
  uint32_t next = 0;   // the chunk that it gave
  uint32_t weight = 0; // that it has used up
  uint32_t rests = 0;  // 1: the chunk is left out
};

// Consecutive lines of the memory block.
struct ActivityStretch {
  uint32_t offset = 0;    // in the memory block
  uint32_t firstLine = 0; // over all stretches
  uint32_t lineCount = 0;
};

// Of one program; host::ActivityMemory makes it.
struct ActivityTables {
  uint32_t task = 0; // whose runs are looked at
  std::span<const ActivityStretch> stretches;
  std::span<const uint32_t> lineOffsets;  // by line
  std::span<const uint32_t> firstWatcher; // by byte of all lines, and one more: in `watchers`
  std::span<const uint32_t> watchers;     // chunks that a change of the byte wakes
  std::span<const uint32_t> firstWritten; // by chunk, and one more: in `writtenLines`
  std::span<const uint32_t> writtenLines; // that the chunk may change
  std::span<const uint8_t> mayRest;       // by chunk
  std::span<Rest> rests;                  // by chunk
  std::span<uint8_t> copy;                // of the lines
};

class Activity {
public:
  Activity() = default;
  explicit Activity(const ActivityTables& tables) noexcept : tables_(tables) { forget(); }

  bool of(uint32_t task) const noexcept { return !tables_.rests.empty() && tables_.task == task; }
  // Whether the run that begins is to be looked at. Counts runs.
  bool looks() noexcept;
  // Before the first chunk of a run, and where a part of one begins.
  void begin(const uint8_t* memory) noexcept;
  const Rest& rest(uint32_t chunk) noexcept {
    ++passed_;
    return tables_.rests[chunk];
  }
  // After a chunk that ran, with what it gave and used.
  void ran(const uint8_t* memory, uint32_t chunk, uint32_t next, uint32_t weight) noexcept;
  void end() noexcept;

  // No chunk rests any more: memory or code has been replaced.
  void forget() noexcept;

private:
  bool take(const uint8_t* memory, uint32_t line) noexcept;

  ActivityTables tables_;
  uint32_t passed_ = 0; // chunks in this run, also those that were left out
  uint32_t ran_ = 0;
  uint32_t without_ = 0; // runs that are not looked at, still
};

} // namespace rung::rt
