// Access of the CNC to the areas of a program: it reads X and G and writes F. An area that the program does not
// have reads 0, and writing it does nothing. The instance and the areas outlive it.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "rtlib/core/bits.h"
#include "rtlib/run/instance.h"

namespace rung::nc::pmc {

// The places of an area's bytes in the memory block, looked up once because the CNC accesses hundreds of them in each
// slot.
class Area {
public:
  Area(const rung_program& program, std::string_view name);

  // Cells that are partly or completely outside read 0, and writing them does nothing.
  bool bit(const uint8_t* block, uint32_t byte, uint32_t bit) const noexcept {
    if (byte >= places_.size()) return false;
    const Place place = places_[byte];
    return place.expanded ? (block[place.offset + bit] & 1) != 0 : ((block[place.offset] >> bit) & 1) != 0;
  }
  void setBit(uint8_t* block, uint32_t byte, uint32_t bit, bool value) const noexcept {
    if (byte >= places_.size()) return;
    const Place place = places_[byte];
    uint8_t& cell = block[place.expanded ? place.offset + bit : place.offset];
    cell = place.expanded ? uint8_t{value} : static_cast<uint8_t>((cell & ~(1u << bit)) | uint32_t{value} << bit);
  }
  // A little-endian number of up to four bytes.
  template <class Number>
  Number read(const uint8_t* block, uint32_t byte) const noexcept {
    uint32_t value = 0;
    if (!contains(byte, sizeof(Number))) return 0;
    for (uint32_t i = 0; i < sizeof(Number); ++i) value |= uint32_t{readByte(block, places_[byte + i])} << 8 * i;
    return static_cast<Number>(value);
  }
  template <class Number>
  void write(uint8_t* block, uint32_t byte, Number value) const noexcept {
    if (!contains(byte, sizeof(Number))) return;
    for (uint32_t i = 0; i < sizeof(Number); ++i)
      writeByte(block, places_[byte + i], static_cast<uint8_t>(uint32_t{value} >> 8 * i));
  }

private:
  struct Place {
    uint32_t offset = 0;   // in the block
    bool expanded = false; // each of its bits has a byte
  };

  bool contains(uint32_t byte, uint32_t size) const noexcept {
    return size <= places_.size() && byte <= places_.size() - size;
  }
  static uint8_t readByte(const uint8_t* block, Place place) noexcept {
    return place.expanded ? core::packBits(block + place.offset) : block[place.offset];
  }
  static void writeByte(uint8_t* block, Place place, uint8_t value) noexcept {
    if (place.expanded)
      core::unpackBits(value, block + place.offset);
    else
      block[place.offset] = value;
  }

  std::vector<Place> places_; // by byte; empty: the program does not have the area
};

struct Areas {
  explicit Areas(const rung_program& program) : x(program, "X"), f(program, "F"), g(program, "G") {}

  Area x, f, g;
};

class SignalsIo {
public:
  SignalsIo(runtime::Instance& instance, const Areas& areas) : block_(instance.block().data()), areas_(&areas) {}

  bool x(uint32_t byte, uint32_t bit) const { return areas_->x.bit(block_, byte, bit); }
  bool g(uint32_t byte, uint32_t bit) const { return areas_->g.bit(block_, byte, bit); }
  uint8_t gByte(uint32_t byte) const { return areas_->g.read<uint8_t>(block_, byte); }
  uint16_t gWord(uint32_t byte) const { return areas_->g.read<uint16_t>(block_, byte); }
  uint32_t gDword(uint32_t byte) const { return areas_->g.read<uint32_t>(block_, byte); }
  bool f(uint32_t byte, uint32_t bit) const { return areas_->f.bit(block_, byte, bit); }
  uint32_t fDword(uint32_t byte) const { return areas_->f.read<uint32_t>(block_, byte); }

  void setF(uint32_t byte, uint32_t bit, bool value) const { areas_->f.setBit(block_, byte, bit, value); }
  void setFByte(uint32_t byte, uint8_t value) const { areas_->f.write(block_, byte, value); }
  void setFWord(uint32_t byte, uint16_t value) const { areas_->f.write(block_, byte, value); }
  void setFDword(uint32_t byte, uint32_t value) const { areas_->f.write(block_, byte, value); }

private:
  uint8_t* block_;
  const Areas* areas_;
};

} // namespace rung::nc::pmc
