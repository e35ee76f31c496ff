// What a scan of a program reads, a line of the processor's cache after the other: its tables, its memory and its code.
// Who touches that shortly before a scan finds it in the caches then, also after a sleep in which others had them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rung/program.h"

namespace rung::runtime {

class Footprint {
public:
  static constexpr uint32_t kLine = 64; // bytes of a line

  // The program outlives it, and has passed checkProgram. `inFile`: it is all that an object file has, which is loaded.
  Footprint(const rung_program& program, bool inFile);

  // Reads a byte of each line, once, of an instance whose memory block that is; ends before that where CLOCK_MONOTONIC
  // has come to `untilNs`. Writes nothing, and allocates, locks and calls nothing but the clock.
  void prefetch(const uint8_t* memory, int64_t untilNs) const noexcept;

  // Parts of the memory block that a run of a task, a border copy or the compiler's own state may use: ascending, in
  // whole lines but for the end of the block, none touches the next.
  std::span<const rung_span> memory() const noexcept { return memory_; }
  // From the program's first chunk on; empty for code that is in no file of its own.
  std::span<const uint8_t> code() const noexcept { return code_; }

private:
  std::vector<std::span<const uint8_t>> tables_;
  std::vector<rung_span> memory_;
  std::span<const uint8_t> code_;
};

} // namespace rung::runtime
