// Conversions between the two representations of a logical byte (enum rung_repr), eight bits at a time.
#pragma once
#include <cstdint>
#include <cstring>

namespace rung::core {

// The byte whose bits are the lowest bits of eight bytes.
inline uint8_t packBits(const uint8_t* bits) noexcept {
  uint64_t bytes;
  std::memcpy(&bytes, bits, sizeof bytes);
  return static_cast<uint8_t>((bytes & 0x0101010101010101u) * 0x0102040810204080u >> 56);
}

// Stores each bit of the byte in a byte of its own. The mask leaves bit b in byte b; the sum carries it to the top of
// that byte.
inline void unpackBits(uint8_t byte, uint8_t* bits) noexcept {
  const uint64_t chosen = (byte * 0x0101010101010101u) & 0x8040201008040201u;
  const uint64_t bytes = ((chosen + 0x00406070787C7E7Fu) >> 7) & 0x0101010101010101u;
  std::memcpy(bits, &bytes, sizeof bytes);
}

} // namespace rung::core
