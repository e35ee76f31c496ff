// Place: a location in the memory block that is looked up once and read or written in every scan. Memory creates Places
// and accesses the block through them; they are valid for the life of the program.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "rung/program.h"

namespace rung::core {

// A bit, or an integer or real of up to eight bytes. Whatever its width and alignment, its bits are adjacent within the
// eight bytes of the block at `window`, so a load, a mask and a shift extract it. Integers whose bits have a byte each
// are scattered (`apart`), and are assembled byte by byte. A default Place is outside all spaces: it reads 0, and
// writing it does nothing.
struct Place {
  uint64_t mask = 0;          // in the window; 0: outside, or apart
  uint64_t one = 0;           // the lowest bit in the window: multiplying by it shifts
  uint32_t window = 0;        // offset in the block
  uint8_t shift = 0;          // of the lowest bit in the window
  uint8_t above = 0;          // bits of the window above the highest
  uint8_t unused = 0;         // shift + above
  bool real = false;          // the bits of a double
  uint32_t space = RUNG_NONE; // start of a scattered place; RUNG_NONE: it is not scattered
  uint32_t byte = 0;

  bool apart() const noexcept { return space != RUNG_NONE; }
  bool outside() const noexcept { return mask == 0 && !apart(); }
  uint32_t width() const noexcept { return 64u - unused; } // in bits; only if it is not outside
  // The byte of the block that holds the lowest bit, and the bit's number in it. Only for a place with a mask.
  uint32_t offset() const noexcept { return window + shift / 8u; }
  uint32_t bit() const noexcept { return shift % 8u; }
};

// The memory block of an instance as the dialect addresses it: logical bytes and bits of spaces, whatever their
// representation. Everything that is not generated code reads and writes through this (or through places found by it).

class Memory {
public:
  static constexpr uint32_t kLeastBlock = 16; // minimum size of a block in bytes, whatever the program needs
  Memory(const rung_program& program, uint8_t* block) noexcept : program_(&program), block_(block) {}

  const rung_program& program() const noexcept { return *program_; }
  uint8_t* block() const noexcept { return block_; }

  bool contains(uint32_t space, uint32_t byte, uint32_t size) const noexcept;
  // The range that contains the byte: its representation and its place in the block. Null: the byte is outside the
  // space.
  const rung_range* rangeOf(uint32_t space, uint32_t byte) const noexcept;

  // Outside the space reads give 0 and writes do nothing.
  uint8_t readByte(uint32_t space, uint32_t byte) const noexcept;
  void writeByte(uint32_t space, uint32_t byte, uint8_t value) const noexcept;
  bool readBit(uint32_t space, uint32_t byte, uint32_t bit) const noexcept;
  void writeBit(uint32_t space, uint32_t byte, uint32_t bit, bool value) const noexcept;
  // `size` <= 8 bytes, low byte first.
  uint64_t read(uint32_t space, uint32_t byte, uint32_t size) const noexcept;
  void write(uint32_t space, uint32_t byte, uint32_t size, uint64_t value) const noexcept;

  // The Place of a bit (bit < 8) or of `size` bytes. If it is outside its space, or longer than eight bytes, the Place
  // is outside.
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
  // Writes the lowest bits of the value.
  void write(const Place& place, uint64_t value) const noexcept {
    if (place.apart()) return writeApart(program_, block_, place, value);
    const uint64_t before = load(place);
    const uint64_t after = before ^ (((value * place.one) ^ before) & place.mask);
    std::memcpy(block_ + place.window, &after, sizeof after);
  }
  // A place that does not hold a real is converted: read as a signed integer; written rounded to the nearest integer
  // and saturated to its width. A bit is written as 1 if the value is not 0.
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
  // Access byte by byte. Static, so that loops keep the fields of a Memory in registers.
  static uint64_t readApart(const rung_program* program, uint8_t* block, const Place& place) noexcept;
  static int64_t readSignedApart(const rung_program* program, uint8_t* block, const Place& place) noexcept;
  static void writeApart(const rung_program* program, uint8_t* block, const Place& place, uint64_t value) noexcept;

  const rung_program* program_;
  uint8_t* block_;
};

// Lists of places: all values that a machine exchanges with a program in one direction are read or written by one call,
// to or from an array of 64-bit words.

// The representation of a place's value in its word.
enum class ValueForm : uint8_t {
  Raw,    // the bits of the place, zero-extended
  Signed, // sign-extended; written as Raw
  Real,   // the bits of a double, in units of `scale`; an integer place is converted
};

struct ListedPlace {
  Place place;
  ValueForm form = ValueForm::Raw;
  double scale = 1; // the program's units in one of the machine's; not 0
};

// `values` has as many elements as `places`.
inline void readPlaces(Memory memory, std::span<const ListedPlace> places, std::span<uint64_t> values) noexcept {
  for (size_t i = 0; i < places.size(); ++i) {
    const ListedPlace& from = places[i];
    switch (from.form) {
    case ValueForm::Raw: values[i] = memory.read(from.place); break;
    case ValueForm::Signed: values[i] = static_cast<uint64_t>(memory.readSigned(from.place)); break;
    case ValueForm::Real: values[i] = std::bit_cast<uint64_t>(memory.readReal(from.place) / from.scale); break;
    }
  }
}

inline void writePlaces(Memory memory, std::span<const ListedPlace> places, std::span<const uint64_t> values) noexcept {
  for (size_t i = 0; i < places.size(); ++i) {
    const ListedPlace& to = places[i];
    if (to.form == ValueForm::Real)
      memory.writeReal(to.place, std::bit_cast<double>(values[i]) * to.scale);
    else
      memory.write(to.place, values[i]);
  }
}

// The process-image copies of tasks without the bytes that no rung accesses: an NC's area has thousands of bytes, of
// which a program uses few. Code that accesses the memory from outside also needs the bytes that are left out.

struct NeededCopies {
  struct Range { // in `copies`
    uint32_t first = 0;
    uint32_t count = 0;
  };
  struct Task {
    Range begin, end;
  };

  std::span<const rung_copy> of(const Range& range) const noexcept { return copies.subspan(range.first, range.count); }
  // Whether any of the bytes is left out.
  bool leavesOut(uint32_t offset, uint32_t size) const noexcept {
    for (const rung_copy& copy : leftOut)
      if (offset < copy.to + copy.size && copy.to < offset + size) return true;
    return false;
  }
  void copyLeftOut(uint8_t* memory) const noexcept {
    for (const rung_copy& copy : leftOut) std::memcpy(memory + copy.to, memory + copy.from, copy.size);
  }

  std::span<const rung_copy> copies;
  std::span<const Task> tasks; // as in the program
  std::span<const rung_copy> leftOut;
};

} // namespace rung::core
