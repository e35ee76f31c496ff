// The memory block of an instance as the dialect addresses it: logical bytes and bits of spaces, whatever their
// representation. Everything that is not generated code reads and writes through this (or through places found by it).
#pragma once
#include <cstdint>

#include "rung/program.h"

namespace rung::rt {

// A bit of the block: `mask` of the byte at `offset`. In an expanded byte the mask is 1.
struct BitPlace {
  uint32_t offset = RUNG_NONE; // RUNG_NONE: outside the space
  uint8_t mask = 0;
};

class Memory {
public:
  Memory(const rung_program& program, uint8_t* block) noexcept : program_(&program), block_(block) {}

  const rung_program& program() const noexcept { return *program_; }
  uint8_t* block() const noexcept { return block_; }

  bool contains(uint32_t space, uint32_t byte, uint32_t size) const noexcept;

  // Outside the space reads give 0 and writes do nothing.
  uint8_t readByte(uint32_t space, uint32_t byte) const noexcept;
  void writeByte(uint32_t space, uint32_t byte, uint8_t value) const noexcept;
  bool readBit(uint32_t space, uint32_t byte, uint32_t bit) const noexcept;
  void writeBit(uint32_t space, uint32_t byte, uint32_t bit, bool value) const noexcept;
  // `size` <= 8 bytes, low byte first.
  uint64_t read(uint32_t space, uint32_t byte, uint32_t size) const noexcept;
  void write(uint32_t space, uint32_t byte, uint32_t size, uint64_t value) const noexcept;

  // Places hold for the life of the program; for code that maps the same bits in every scan. bit < 8.
  BitPlace bitPlace(uint32_t space, uint32_t byte, uint32_t bit) const noexcept;
  bool readPlace(BitPlace place) const noexcept { return (block_[place.offset] & place.mask) != 0; }
  void writePlace(BitPlace place, bool value) const noexcept {
    uint8_t& cell = block_[place.offset];
    cell = static_cast<uint8_t>(value ? cell | place.mask : cell & ~place.mask);
  }

private:
  const rung_range* rangeOf(uint32_t space, uint32_t byte) const noexcept;

  const rung_program* program_;
  uint8_t* block_;
};

} // namespace rung::rt
