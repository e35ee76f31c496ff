// What a program's own code writes, by its tables.
#pragma once
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>

#include "rung/program.h"

namespace rung::runtime {

// Calls visit(offset) for each byte of the memory block to or from which process-image copies (task entry and exit)
// copy this one.
template <class Visit>
void forCopiesOf(const rung_program& program, uint32_t offset, Visit visit) {
  for (uint32_t i = 0; i < program.copy_count; ++i) {
    const rung_copy& copy = program.copies[i];
    if (offset - copy.from < copy.size) visit(offset - copy.from + copy.to);
    if (offset - copy.to < copy.size) visit(offset - copy.to + copy.from);
  }
}

// The bits of a byte of the memory block that a program's own code may write, as a mask. Allocates nothing.
inline uint8_t writtenBits(const rung_program& program, uint32_t offset) {
  const std::span<const rung_written> writes(program.writes, program.write_count);
  const auto after = std::ranges::upper_bound(writes, offset, {}, &rung_written::offset);
  if (after == writes.begin()) return 0;
  const rung_written& written = *std::prev(after);
  return offset - written.offset < written.size ? written.mask : uint8_t{0};
}

} // namespace rung::runtime
