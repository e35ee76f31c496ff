// From cells to bits, and where these are copied (see forcing.h).
#include "rtlib/host/forcing.h"

#include <algorithm>

namespace rung::host {

Forcing::Forcing(const rung_program& program, void* engine, std::span<const ForcedCell> cells)
    : program_(program), code_{program.chunk_fns, engine} {
  for (const ForcedCell& cell : cells) add(cell);
  for (const auto& [offset, bits] : bits_) {
    held_.push_back({.offset = offset, .mask = bits.mask, .value = bits.value});
    needsCode_ = needsCode_ || isWritten(offset, bits.mask);
  }
  nameBytes();
}

void Forcing::add(const ForcedCell& cell) {
  const Ref& ref = cell.ref;
  if (ref.kind == RefKind::Constant || ref.kind == RefKind::Text) {
    problem_ = "a text or a constant cannot be forced";
    return;
  }
  if (ref.kind == RefKind::Bit) {
    const auto mask = static_cast<uint8_t>(1u << ref.bit);
    addByte(ref.space, ref.byte, mask, (cell.bits & 1) != 0 ? mask : 0);
    return;
  }
  for (uint32_t i = 0; i < ref.width / 8u; ++i)
    addByte(ref.space, ref.byte + i, 0xFF, static_cast<uint8_t>(cell.bits >> (8 * i)));
}

void Forcing::addByte(uint32_t space, uint32_t byte, uint8_t mask, uint8_t value) {
  const rung_range* range = rt::Memory(program_, nullptr).rangeOf(space, byte);
  if (range == nullptr) {
    problem_ = "a forced cell lies outside its space";
    return;
  }
  const uint32_t inRange = byte - range->first_byte;
  if (range->repr == RUNG_REPR_PACKED) return hold(range->offset + inRange, {.mask = mask, .value = value});
  for (uint32_t bit = 0; bit < 8; ++bit) {
    const auto on = static_cast<uint8_t>(value >> bit & 1);
    if ((mask >> bit & 1) != 0) hold(range->offset + inRange * 8 + bit, {.mask = 1, .value = on});
  }
}

void Forcing::hold(uint32_t offset, Bits bits) {
  Bits& held = bits_[offset];
  const auto both = static_cast<uint8_t>(held.mask & bits.mask);
  if (((held.value ^ bits.value) & both) != 0) problem_ = "two forces want different values in one place";
  if (both == bits.mask) return;
  held.mask |= bits.mask;
  held.value = static_cast<uint8_t>((held.value & ~bits.mask) | bits.value);
  holdCopies(offset, bits);
}

void Forcing::holdCopies(uint32_t offset, Bits bits) {
  for (uint32_t i = 0; i < program_.copy_count; ++i) {
    const rung_copy& copy = program_.copies[i];
    if (offset - copy.from < copy.size) hold(offset - copy.from + copy.to, bits);
    if (offset - copy.to < copy.size) hold(offset - copy.to + copy.from, bits);
  }
}

// The same bits as spaces have them.
void Forcing::nameBytes() {
  std::map<std::pair<uint32_t, uint32_t>, Bits> named;
  for (uint32_t space = 0; space < program_.space_count; ++space) {
    for (uint32_t r = 0; r < program_.spaces[space].range_count; ++r) {
      const rung_range& range = program_.spaces[space].ranges[r];
      const bool expanded = range.repr == RUNG_REPR_BYTE_PER_BIT;
      const uint32_t end = range.offset + range.byte_count * (expanded ? 8 : 1);
      for (auto it = bits_.lower_bound(range.offset); it != bits_.end() && it->first < end; ++it) {
        const uint32_t inRange = it->first - range.offset;
        const uint32_t shift = expanded ? inRange % 8 : 0;
        Bits& bits = named[{space, range.first_byte + (expanded ? inRange / 8 : inRange)}];
        bits.mask |= static_cast<uint8_t>(it->second.mask << shift);
        bits.value |= static_cast<uint8_t>(it->second.value << shift);
      }
    }
  }
  for (const auto& [place, bits] : named)
    bytes_.push_back({.space = place.first, .byte = place.second, .mask = bits.mask, .value = bits.value});
}

bool Forcing::isWritten(uint32_t offset, uint8_t mask) const {
  const std::span<const rung_written> writes(program_.writes, program_.write_count);
  const auto after = std::ranges::upper_bound(writes, offset, {}, &rung_written::offset);
  if (after == writes.begin()) return false;
  const rung_written& written = *std::prev(after);
  return offset - written.offset < written.size && (written.mask & mask) != 0;
}

} // namespace rung::host
