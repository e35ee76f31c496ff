// The meaning of types of cells (rung_type) and of keys in the program tables. C++; the tables themselves are C.
#ifndef RUNG_TYPES_HPP
#define RUNG_TYPES_HPP

#include <cstdint>

#include "rung/program.h"

namespace rung {

// Bits of one element of a symbol or slot; 0: not a rung_type.
constexpr uint32_t elementBits(uint32_t type) {
  switch (type) {
  case RUNG_TYPE_BIT: return 1;
  case RUNG_TYPE_I8:
  case RUNG_TYPE_TEXT: return 8;
  case RUNG_TYPE_I16: return 16;
  case RUNG_TYPE_I32: return 32;
  case RUNG_TYPE_I64:
  case RUNG_TYPE_F64: return 64;
  default: return 0;
  }
}

// Bytes of the memory block that one byte of a space takes in this representation (rung_range::repr).
constexpr uint32_t bytesPerByte(uint32_t repr) { return repr == RUNG_REPR_BYTE_PER_BIT ? 8 : 1; }

// The key of a rung. `text` is a hash of its text and its routine's name, `copy` the number of earlier rungs of the
// routine with the same text.
constexpr uint64_t rungKey(uint64_t text, uint32_t copy) {
  constexpr uint64_t kStep = 0x9E37'79B9'7F4A'7C15;
  return text + kStep * copy;
}
// The `text` of a key.
constexpr uint64_t textOfKey(uint64_t key, uint32_t copy) { return key - rungKey(0, copy); }

} // namespace rung
#endif
