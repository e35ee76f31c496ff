// What the types of cells in the program tables (rung_type) mean. C++; the tables themselves are C.
#ifndef RUNG_TYPES_HPP
#define RUNG_TYPES_HPP

#include <cstdint>

#include "rung/program.h"

namespace rung {

// Bits of one element of a symbol or slot; 0: no rung_type has this number.
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

} // namespace rung
#endif
