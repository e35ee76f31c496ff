// A place of the memory block that was looked up once: what is read and written in every scan. Memory makes it and
// reads and writes through it (memory.h); it holds for the life of the program.
#pragma once
#include <cstdint>

#include "rung/program.h"

namespace rung::core {

// A bit, or an integer or real of up to eight bytes. Its bits lie together in the eight bytes of the block at `window`,
// whatever its width and alignment: a load, a mask and a shift find it. Integers with bits in bytes of their own lie
// apart, and are put together byte by byte. A default Place is outside all spaces: it reads 0, and writing it does
// nothing.
struct Place {
  uint64_t mask = 0;          // in the window; 0: outside, or apart
  uint64_t one = 0;           // the lowest bit in the window: a product with it is a shift
  uint32_t window = 0;        // offset in the block
  uint8_t shift = 0;          // of the lowest bit in the window
  uint8_t above = 0;          // bits of the window above the highest
  uint8_t unused = 0;         // shift + above
  bool real = false;          // the bits of a double
  uint32_t space = RUNG_NONE; // of a place that lies apart, where it begins; else RUNG_NONE
  uint32_t byte = 0;

  bool apart() const noexcept { return space != RUNG_NONE; }
  bool outside() const noexcept { return mask == 0 && !apart(); }
  uint32_t width() const noexcept { return 64u - unused; } // in bits; of one that is not outside
  // The byte of the block that holds the lowest bit, and its number in it; of one that has a mask.
  uint32_t offset() const noexcept { return window + shift / 8u; }
  uint32_t bit() const noexcept { return shift % 8u; }
};

} // namespace rung::core
