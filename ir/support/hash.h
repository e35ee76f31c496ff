// FNV-1a, for keys that must be the same on every machine: rung keys, layout and code hashes.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace rung {

inline constexpr uint64_t kHashSeed = 0xCBF29CE484222325ull;

constexpr uint64_t hashBytes(std::string_view bytes, uint64_t seed = kHashSeed) {
  for (char c : bytes) seed = (seed ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  return seed;
}

// Hash of whole numbers: each bit of each number affects the whole hash.
constexpr uint64_t hashNumber(uint64_t number, uint64_t seed) {
  seed = (seed ^ number) * 0x9E3779B97F4A7C15ull;
  return seed ^ (seed >> 32);
}

// Hash of a text, eight bytes at a time.
inline uint64_t hashText(std::string_view text, uint64_t seed) {
  seed = hashNumber(text.size(), seed);
  uint64_t word = 0;
  for (; text.size() >= sizeof word; text.remove_prefix(sizeof word)) {
    std::memcpy(&word, text.data(), sizeof word);
    if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word); // the same hash everywhere
    seed = hashNumber(word, seed);
  }
  word = 0;
  for (const char c : text) word = word << 8 | static_cast<unsigned char>(c);
  return text.empty() ? seed : hashNumber(word, seed);
}

} // namespace rung
