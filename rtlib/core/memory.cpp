// Logical access to the memory block: one binary search for the range, then the byte or its eight bits.
#include "rtlib/core/memory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rtlib/core/bits.h"

namespace rung::core {

bool Memory::contains(uint32_t space, uint32_t byte, uint32_t size) const noexcept {
  if (space >= program_->space_count) return false;
  const uint32_t count = program_->spaces[space].byte_count;
  return size <= count && byte <= count - size;
}

const rung_range* Memory::rangeOf(uint32_t space, uint32_t byte) const noexcept {
  if (!contains(space, byte, 1)) return nullptr;
  const rung_space& s = program_->spaces[space];
  uint32_t low = 0;
  uint32_t high = s.range_count;
  while (high - low > 1) { // bisection: at most 32 iterations
    const uint32_t middle = low + (high - low) / 2;
    if (s.ranges[middle].first_byte <= byte) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return &s.ranges[low];
}

uint8_t Memory::readByte(uint32_t space, uint32_t byte) const noexcept {
  const rung_range* range = rangeOf(space, byte);
  if (range == nullptr) return 0;
  const uint32_t index = byte - range->first_byte;
  if (range->repr == RUNG_REPR_BYTE_PER_BIT) return packBits(block_ + range->offset + size_t{8} * index);
  return block_[range->offset + index];
}

void Memory::writeByte(uint32_t space, uint32_t byte, uint8_t value) const noexcept {
  const rung_range* range = rangeOf(space, byte);
  if (range == nullptr) return;
  const uint32_t index = byte - range->first_byte;
  if (range->repr == RUNG_REPR_BYTE_PER_BIT) {
    unpackBits(value, block_ + range->offset + size_t{8} * index);
  } else {
    block_[range->offset + index] = value;
  }
}

// ---- places ------------------------------------------------------------------------------------------------------

// For the last bytes of the block, the window ends at the end of the block.
Place Memory::inWindow(uint32_t offset, uint32_t bit, uint32_t width) const noexcept {
  Place place;
  constexpr uint32_t kWindow = sizeof(uint64_t);
  place.window = std::min(offset, std::max(program_->memory_size, kLeastBlock) - kWindow);
  place.shift = static_cast<uint8_t>(8 * (offset - place.window) + bit);
  place.unused = static_cast<uint8_t>(64 - width);
  place.above = static_cast<uint8_t>(place.unused - place.shift);
  place.one = uint64_t{1} << place.shift;
  place.mask = (~uint64_t{0} >> place.unused) << place.shift;
  return place;
}

// Whether the bytes are packed and adjacent in the block. They must be inside their space, and `byte` in `range`.
bool Memory::together(const rung_range* range, uint32_t byte, uint32_t size) const noexcept {
  for (; range->repr == RUNG_REPR_PACKED; ++range) {
    if (byte + size - range->first_byte <= range->byte_count) return true;
    if (range[1].offset != range->offset + range->byte_count) return false;
  }
  return false;
}

Place Memory::locateBit(uint32_t space, uint32_t byte, uint32_t bit) const noexcept {
  const rung_range* range = rangeOf(space, byte);
  if (range == nullptr || bit > 7) return {};
  const uint32_t index = byte - range->first_byte;
  if (range->repr == RUNG_REPR_BYTE_PER_BIT) return inWindow(range->offset + 8 * index + bit, 0, 1);
  return inWindow(range->offset + index, bit, 1);
}

Place Memory::locate(uint32_t space, uint32_t byte, uint32_t size) const noexcept {
  if (size == 0 || size > 8 || !contains(space, byte, size)) return {};
  const rung_range* range = rangeOf(space, byte);
  if (together(range, byte, size)) return inWindow(range->offset + (byte - range->first_byte), 0, 8 * size);
  Place place;
  place.unused = place.above = static_cast<uint8_t>(64 - 8 * size);
  place.space = space;
  place.byte = byte;
  return place;
}

uint64_t Memory::readApart(const rung_program* program, uint8_t* block, const Place& place) noexcept {
  const Memory memory(*program, block);
  uint64_t value = 0;
  for (uint32_t i = 0; i < place.width() / 8; ++i)
    value |= uint64_t{memory.readByte(place.space, place.byte + i)} << (8 * i);
  return value;
}

int64_t Memory::readSignedApart(const rung_program* program, uint8_t* block, const Place& place) noexcept {
  return extended(readApart(program, block, place), place);
}

void Memory::writeApart(const rung_program* program, uint8_t* block, const Place& place, uint64_t value) noexcept {
  const Memory memory(*program, block);
  for (uint32_t i = 0; i < place.width() / 8; ++i)
    memory.writeByte(place.space, place.byte + i, static_cast<uint8_t>(value >> (8 * i)));
}

namespace {

// Rounds to nearest, saturating to the signed range; NaN gives 0.
int64_t saturated(double value, uint32_t width) noexcept {
  if (std::isnan(value)) return 0;
  const int64_t highest = std::numeric_limits<int64_t>::max() >> (64 - width);
  const double rounded = std::nearbyint(value);
  if (rounded >= -static_cast<double>(-highest - 1)) return highest;
  if (rounded < static_cast<double>(-highest - 1)) return -highest - 1;
  return static_cast<int64_t>(rounded);
}

} // namespace

void Memory::writeReal(const Place& place, double value) const noexcept {
  if (place.real) {
    write(place, std::bit_cast<uint64_t>(value));
  } else if (place.width() == 1) {
    write(place, value != 0 ? 1 : 0);
  } else {
    write(place, static_cast<uint64_t>(saturated(value, place.width())));
  }
}

// ---- by address --------------------------------------------------------------------------------------------------

bool Memory::readBit(uint32_t space, uint32_t byte, uint32_t bit) const noexcept {
  return read(locateBit(space, byte, bit)) != 0;
}

void Memory::writeBit(uint32_t space, uint32_t byte, uint32_t bit, bool value) const noexcept {
  write(locateBit(space, byte, bit), value ? 1 : 0);
}

uint64_t Memory::read(uint32_t space, uint32_t byte, uint32_t size) const noexcept {
  return read(locate(space, byte, size));
}

void Memory::write(uint32_t space, uint32_t byte, uint32_t size, uint64_t value) const noexcept {
  write(locate(space, byte, size), value);
}

} // namespace rung::core
