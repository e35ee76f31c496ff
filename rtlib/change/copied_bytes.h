// Where a byte of the memory block is copied to and from at the borders of tasks.
#pragma once
#include <cstdint>

#include "rung/program.h"

namespace rung::runtime {

// Calls visit(offset) for each byte that this one is copied to or from.
template <class Visit>
void forCopiesOf(const rung_program& program, uint32_t offset, Visit visit) {
  for (uint32_t i = 0; i < program.copy_count; ++i) {
    const rung_copy& copy = program.copies[i];
    if (offset - copy.from < copy.size) visit(offset - copy.from + copy.to);
    if (offset - copy.to < copy.size) visit(offset - copy.to + copy.from);
  }
}

} // namespace rung::runtime
