// Sums and products that saturate at the largest number.
#pragma once
#include <cstdint>

namespace rung {

constexpr uint64_t saturatedSum(uint64_t a, uint64_t b) { return a > UINT64_MAX - b ? UINT64_MAX : a + b; }
constexpr uint64_t saturatedProduct(uint64_t a, uint64_t b) {
  return b != 0 && a > UINT64_MAX / b ? UINT64_MAX : a * b;
}

} // namespace rung
