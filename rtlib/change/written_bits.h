// Which bits of the memory block a program's own code may write.
#pragma once
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>

#include "rung/program.h"

namespace rung::runtime {

// Those of one byte. Allocates nothing.
inline uint8_t writtenBits(const rung_program& program, uint32_t offset) {
  const std::span<const rung_written> writes(program.writes, program.write_count);
  const auto after = std::ranges::upper_bound(writes, offset, {}, &rung_written::offset);
  if (after == writes.begin()) return 0;
  const rung_written& written = *std::prev(after);
  return offset - written.offset < written.size ? written.mask : uint8_t{0};
}

} // namespace rung::runtime
