// Where the value of a HAL pin is. HAL redirects these pointers when a pin is linked to a signal, so they lie in HAL's
// memory and are read anew in every scan.
#pragma once
#include <cstdint>

namespace rung::plc {

union PinCell {
  volatile bool* bit;
  volatile int32_t* s32;
  volatile uint32_t* u32;
  volatile double* real;
  void* any;
};

} // namespace rung::plc
