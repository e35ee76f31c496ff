// From cells to bits, and to the bits that copies connect with them.
#include "rtlib/change/forcing.h"

#include <algorithm>
#include <optional>

#include "rtlib/load/program_info.h"

namespace rung::runtime {

Forcing::Forcing(const rung_program& program, void* engine, std::span<const ForcedCell> cells)
    : program_(program), code_{program.chunk_fns, engine} {
  for (const ForcedCell& cell : cells) add(cell);
  finish();
}

Forcing::Forcing(const rung_program& program, void* engine, std::span<const core::ForcedBits> bits)
    : program_(program), code_{program.chunk_fns, engine} {
  for (const core::ForcedBits& each : bits) bits_[each.offset] = {.mask = each.mask, .value = each.value};
  finish();
}

void Forcing::finish() {
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
    addByte(cell.name, ref.space, ref.byte, mask, (cell.bits & 1) != 0 ? mask : 0);
    return;
  }
  for (uint32_t i = 0; i < ref.width / 8u; ++i)
    addByte(cell.name, ref.space, ref.byte + i, 0xFF, static_cast<uint8_t>(cell.bits >> (8 * i)));
}

void Forcing::addByte(std::string_view name, uint32_t space, uint32_t byte, uint8_t mask, uint8_t value) {
  const core::Memory memory(program_, nullptr);
  for (uint32_t bit = 0; bit < 8; ++bit) {
    if ((mask >> bit & 1) == 0) continue;
    const core::Place place = memory.locateBit(space, byte, bit);
    if (place.outside()) {
      problem_ = "a forced cell lies outside its space";
      return;
    }
    const auto held = static_cast<uint8_t>(1u << place.bit());
    hold(name, place.offset(), {.mask = held, .value = (value >> bit & 1) != 0 ? held : uint8_t{0}});
  }
}

void Forcing::hold(std::string_view name, uint32_t offset, Bits bit) {
  Bits& held = bits_[offset];
  const auto [holder, isNew] = holders_.try_emplace({offset, bit.mask}, name);
  if (((held.value ^ bit.value) & held.mask & bit.mask) != 0)
    problem_ = "two forces want different values in one place: " + holder->second + " and " + std::string(name);
  if (!isNew) return;
  held.mask |= bit.mask;
  held.value = static_cast<uint8_t>((held.value & ~bit.mask) | bit.value);
  forCopiesOf(program_, offset, [&](uint32_t copied) { hold(name, copied, bit); });
}

// The forced bits by bytes of spaces.
void Forcing::nameBytes() {
  std::map<std::pair<uint32_t, uint32_t>, Bits> named;
  const core::Memory memory(program_, nullptr);
  for (const auto& [offset, bits] : bits_) {
    const std::optional<LogicalByte> byte = byteAt(program_, offset);
    if (!byte) continue;
    const rung_range& range = *memory.rangeOf(byte->space, byte->byte);
    const uint32_t shift = range.repr == RUNG_REPR_BYTE_PER_BIT ? (offset - range.offset) % 8 : 0;
    Bits& all = named[{byte->space, byte->byte}];
    all.mask |= static_cast<uint8_t>(bits.mask << shift);
    all.value |= static_cast<uint8_t>(bits.value << shift);
  }
  for (const auto& [place, bits] : named)
    bytes_.push_back({.space = place.first, .byte = place.second, .mask = bits.mask, .value = bits.value});
}

bool Forcing::isWritten(uint32_t offset, uint8_t mask) const { return (writtenBits(program_, offset) & mask) != 0; }

} // namespace rung::runtime
