// The border copies of tasks short of the bytes that no rung touches: an NC's area has thousands of bytes, and a
// program looks at few of them. Who looks at the memory from outside needs what is left out, too.
#pragma once
#include <cstdint>
#include <cstring>
#include <span>

#include "rung/program.h"

namespace rung::core {

struct NeededCopies {
  struct Range { // in `copies`
    uint32_t first = 0;
    uint32_t count = 0;
  };
  struct Task {
    Range begin, end;
  };

  std::span<const rung_copy> of(const Range& range) const noexcept { return copies.subspan(range.first, range.count); }
  // One of the bytes is left out.
  bool leavesOut(uint32_t offset, uint32_t size) const noexcept {
    for (const rung_copy& copy : leftOut)
      if (offset < copy.to + copy.size && copy.to < offset + size) return true;
    return false;
  }
  void copyLeftOut(uint8_t* memory) const noexcept {
    for (const rung_copy& copy : leftOut) std::memcpy(memory + copy.to, memory + copy.from, copy.size);
  }

  std::span<const rung_copy> copies;
  std::span<const Task> tasks; // as in the program
  std::span<const rung_copy> leftOut;
};

} // namespace rung::core
