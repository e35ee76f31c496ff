// Which bytes of a program's memory block are what, from its tables.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rung/program.h"

namespace rung::runtime {

using BlockBytes = std::vector<bool>; // by offset in the block

inline void mark(BlockBytes& bytes, size_t offset, size_t count) {
  std::fill_n(bytes.begin() + static_cast<ptrdiff_t>(offset), count, true);
}

// each(offset, count) for bytes that hold one bit each, which is 0 or 1; the code of programs relies on that.
template <class Each>
void eachBits(const rung_program& program, Each each) {
  constexpr size_t kExpanded = 8;
  for (const rung_space& space : std::span(program.spaces, program.space_count))
    for (const rung_range& range : std::span(space.ranges, space.range_count))
      if (range.repr == RUNG_REPR_BYTE_PER_BIT) each(size_t{range.offset}, kExpanded * range.byte_count);
  for (const rung_slot& slot : std::span(program.slots, program.slot_count))
    if (slot.type == RUNG_TYPE_BIT) each(size_t{slot.offset}, size_t{1});
}

// The bytes of spaces that the program may read.
BlockBytes readBytes(const rung_program& program);
// Those that its chunks may write, and those that its process-image copies may write as well.
BlockBytes chunkBytes(const rung_program& program);
BlockBytes writtenBytes(const rung_program& program);
// Those of eachBits.
BlockBytes bitBytes(const rung_program& program);

} // namespace rung::runtime
