// The memory block of an instance as the dialect addresses it: logical bytes and bits of spaces, whatever their
// representation. Everything that is not generated code reads and writes through this (or through places found by it).
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>

#include "rtlib/core/place.h"
#include "rung/program.h"

namespace rung::core {

class Memory {
public:
  static constexpr uint32_t kLeastBlock = 8; // bytes that a block has at least, whatever the program needs
  Memory(const rung_program& program, uint8_t* block) noexcept : program_(&program), block_(block) {}

  const rung_program& program() const noexcept { return *program_; }
  uint8_t* block() const noexcept { return block_; }

  bool contains(uint32_t space, uint32_t byte, uint32_t size) const noexcept;
  // How the byte is represented, and where its range lies in the block. Null: it is outside the space.
  const rung_range* rangeOf(uint32_t space, uint32_t byte) const noexcept;

  // Outside the space reads give 0 and writes do nothing.
  uint8_t readByte(uint32_t space, uint32_t byte) const noexcept;
  void writeByte(uint32_t space, uint32_t byte, uint8_t value) const noexcept;
  bool readBit(uint32_t space, uint32_t byte, uint32_t bit) const noexcept;
  void writeBit(uint32_t space, uint32_t byte, uint32_t bit, bool value) const noexcept;
  // `size` <= 8 bytes, low byte first.
  uint64_t read(uint32_t space, uint32_t byte, uint32_t size) const noexcept;
  void write(uint32_t space, uint32_t byte, uint32_t size, uint64_t value) const noexcept;

  // What lies outside its space, or has more than eight bytes, is a Place outside. bit < 8.
  Place locateBit(uint32_t space, uint32_t byte, uint32_t bit) const noexcept;
  Place locate(uint32_t space, uint32_t byte, uint32_t size) const noexcept;

  uint64_t read(const Place& place) const noexcept {
    if (place.apart()) return readApart(program_, block_, place);
    return (load(place) & place.mask) >> place.shift;
  }
  int64_t readSigned(const Place& place) const noexcept {
    if (place.apart()) return readSignedApart(program_, block_, place);
    return extended(load(place) & place.mask, place);
  }
  // The lowest bits of the value.
  void write(const Place& place, uint64_t value) const noexcept {
    if (place.apart()) return writeApart(program_, block_, place, value);
    const uint64_t before = load(place);
    const uint64_t after = before ^ (((value * place.one) ^ before) & place.mask);
    std::memcpy(block_ + place.window, &after, sizeof after);
  }
  // A place that holds no real is converted: read as a signed integer; written rounded to the nearest one and held in
  // the range of its width, or, a bit, as 0 or not.
  double readReal(const Place& place) const noexcept {
    if (place.real) return std::bit_cast<double>(read(place));
    return static_cast<double>(place.width() == 1 ? static_cast<int64_t>(read(place)) : readSigned(place));
  }
  void writeReal(const Place& place, double value) const noexcept;

private:
  static_assert(std::endian::native == std::endian::little, "the memory of programs is little-endian");

  bool together(const rung_range* range, uint32_t byte, uint32_t size) const noexcept;
  Place inWindow(uint32_t offset, uint32_t bit, uint32_t width) const noexcept;
  uint64_t load(const Place& place) const noexcept {
    uint64_t window = 0;
    std::memcpy(&window, block_ + place.window, sizeof window);
    return window;
  }
  static int64_t extended(uint64_t bits, const Place& place) noexcept {
    return static_cast<int64_t>(bits << place.above) >> place.unused;
  }
  // Byte by byte. Not of an object, so that loops keep the fields of a Memory in registers.
  static uint64_t readApart(const rung_program* program, uint8_t* block, const Place& place) noexcept;
  static int64_t readSignedApart(const rung_program* program, uint8_t* block, const Place& place) noexcept;
  static void writeApart(const rung_program* program, uint8_t* block, const Place& place, uint64_t value) noexcept;

  const rung_program* program_;
  uint8_t* block_;
};

} // namespace rung::core
