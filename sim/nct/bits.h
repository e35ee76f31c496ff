// Sets of axes, spindles, switches … with one bit each.
#pragma once
#include <bit>
#include <cstdint>

namespace rung::sim::nct {

// Calls act(number) for each bit that is 1, the lowest first.
template <class Act>
void forBits(uint32_t bits, Act act) {
  for (; bits != 0; bits &= bits - 1) act(static_cast<uint32_t>(std::countr_zero(bits)));
}

} // namespace rung::sim::nct
