// Where the value of a HAL pin is, and how it is read and written. HAL redirects these pointers when a pin is linked to
// a signal, so they lie in HAL's memory and are read anew in every scan.
#pragma once
#include <cstdint>

#include "machine/host/mapping_file.h"

namespace rung::host {

union PinCell {
  volatile bool* bit;
  volatile int32_t* s32;
  volatile uint32_t* u32;
  volatile double* real;
  void* any;
};

// A value of a pin, or of a constant.
union Value {
  bool bit;
  int32_t s32;
  uint32_t u32;
  double real = 0;
};

// By the type of the pin. A host whose cells are not as wide as their types has its own.
struct PinAccess {
  Value (*read)(PinType type, const PinCell& cell) noexcept;
  void (*write)(PinType type, const PinCell& cell, const Value& value) noexcept;
};

// Cells that point to variables of the pins' types.
extern const PinAccess kVariables;

} // namespace rung::host
