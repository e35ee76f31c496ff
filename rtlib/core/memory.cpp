// Logical access to the memory block: one binary search for the range, then the byte or its eight bits.
#include "rtlib/core/memory.h"

namespace rung::rt {

namespace {

uint8_t gather(const uint8_t* bits) noexcept {
  uint32_t value = 0;
  for (uint32_t b = 0; b < 8; ++b) value |= (bits[b] & 1u) << b;
  return static_cast<uint8_t>(value);
}

void scatter(uint8_t* bits, uint8_t value) noexcept {
  for (uint32_t b = 0; b < 8; ++b) bits[b] = (value >> b) & 1u;
}

} // namespace

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
  while (high - low > 1) { // halves: at most 32 passes
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
  if (range->repr == RUNG_REPR_BYTE_PER_BIT) return gather(block_ + range->offset + 8 * index);
  return block_[range->offset + index];
}

void Memory::writeByte(uint32_t space, uint32_t byte, uint8_t value) const noexcept {
  const rung_range* range = rangeOf(space, byte);
  if (range == nullptr) return;
  const uint32_t index = byte - range->first_byte;
  if (range->repr == RUNG_REPR_BYTE_PER_BIT) {
    scatter(block_ + range->offset + 8 * index, value);
  } else {
    block_[range->offset + index] = value;
  }
}

BitPlace Memory::bitPlace(uint32_t space, uint32_t byte, uint32_t bit) const noexcept {
  const rung_range* range = rangeOf(space, byte);
  if (range == nullptr || bit > 7) return {};
  const uint32_t index = byte - range->first_byte;
  if (range->repr == RUNG_REPR_BYTE_PER_BIT) return {range->offset + 8 * index + bit, 1};
  return {range->offset + index, static_cast<uint8_t>(1u << bit)};
}

bool Memory::readBit(uint32_t space, uint32_t byte, uint32_t bit) const noexcept {
  const BitPlace place = bitPlace(space, byte, bit);
  return place.offset != RUNG_NONE && readPlace(place);
}

void Memory::writeBit(uint32_t space, uint32_t byte, uint32_t bit, bool value) const noexcept {
  const BitPlace place = bitPlace(space, byte, bit);
  if (place.offset != RUNG_NONE) writePlace(place, value);
}

uint64_t Memory::read(uint32_t space, uint32_t byte, uint32_t size) const noexcept {
  uint64_t value = 0;
  if (size > 8 || !contains(space, byte, size)) return 0;
  for (uint32_t i = 0; i < size; ++i) value |= uint64_t{readByte(space, byte + i)} << (8 * i);
  return value;
}

void Memory::write(uint32_t space, uint32_t byte, uint32_t size, uint64_t value) const noexcept {
  if (size > 8 || !contains(space, byte, size)) return;
  for (uint32_t i = 0; i < size; ++i) writeByte(space, byte + i, static_cast<uint8_t>(value >> (8 * i)));
}

} // namespace rung::rt
