// The bytes that a scan of a program reads: tables, memory and code, as lines of the processor's cache. Prefetching
// them shortly before a scan brings them into the caches, even after a sleep in which other programs used these.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rung/program.h"

namespace rung::runtime {

class Footprint {
public:
  static constexpr uint32_t kLine = 64; // bytes of a line

  // The program outlives the footprint, and has passed checkProgram. `inFile`: the program is everything that a loaded
  // object file contains.
  Footprint(const rung_program& program, bool inFile);

  // Reads one byte of each line of an instance whose memory block is `memory`, and stops early when CLOCK_MONOTONIC
  // reaches `untilNs`. Writes nothing; allocates, locks and calls nothing but the clock.
  void prefetch(const uint8_t* memory, int64_t untilNs) const noexcept;

  // Parts of the memory block that a run of a task, a process-image copy or the compiler's own state may use:
  // ascending, in whole lines except at the end of the block, and never adjacent.
  std::span<const rung_span> memory() const noexcept { return memory_; }
  // The code, from the program's first chunk on; empty if it is not in an object file of its own.
  std::span<const uint8_t> code() const noexcept { return code_; }

private:
  std::vector<std::span<const uint8_t>> tables_;
  std::vector<rung_span> memory_;
  std::span<const uint8_t> code_;
};

} // namespace rung::runtime
