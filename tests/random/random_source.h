// Random numbers that are the same on every machine (splitmix64).
#pragma once
#include <cstdint>

namespace rung::ir {

class RandomSource {
public:
  explicit RandomSource(uint64_t seed) : state_(seed) {}

  uint64_t next() {
    uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  // 0 .. n-1; n is at least 1.
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(next() % n); }
  uint32_t between(uint32_t first, uint32_t last) { return first + below(last - first + 1); }
  bool chance(uint32_t percent) { return below(100) < percent; }
  template <class Range>
  const auto& pick(const Range& range) {
    return range[below(static_cast<uint32_t>(range.size()))];
  }

private:
  uint64_t state_;
};

} // namespace rung::ir
