// FNV-1a, for keys that must be the same on every machine: rung keys, layout and code hashes.
#pragma once
#include <cstdint>
#include <string_view>

namespace rung {

inline constexpr uint64_t kHashSeed = 0xCBF29CE484222325ull;

constexpr uint64_t hashBytes(std::string_view bytes, uint64_t seed = kHashSeed) {
  for (char c : bytes) seed = (seed ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  return seed;
}

// Of whole numbers: each bit of each one changes all of the hash.
constexpr uint64_t hashNumber(uint64_t number, uint64_t seed) {
  seed = (seed ^ number) * 0x9E3779B97F4A7C15ull;
  return seed ^ (seed >> 32);
}

} // namespace rung
