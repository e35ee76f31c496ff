// Sets of chunks, a bit each.
#pragma once
#include <cstdint>

namespace rung::rt {

inline constexpr uint32_t kChunkBits = 64; // in a word

// Bits of chunks, of one word: bit k of word w is of chunk 64 * w + k.
struct ChunkBits {
  uint32_t word = 0;
  uint64_t bits = 0;
};

constexpr ChunkBits bitOf(uint32_t chunk) noexcept { return {chunk / kChunkBits, uint64_t{1} << chunk % kChunkBits}; }

} // namespace rung::rt
