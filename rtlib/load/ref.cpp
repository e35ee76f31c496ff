// Places and typed access to them on top of logical bytes.
#include "rtlib/load/ref.h"

#include <algorithm>

namespace rung::runtime {

bool isSamePlace(const Ref& a, const Ref& b) {
  Ref other = b;
  other.readonly = a.readonly;
  return a == other;
}

Ref bitRef(uint32_t space, uint32_t byte, uint32_t bit) {
  Ref ref;
  ref.space = space;
  ref.byte = byte + bit / 8;
  ref.bit = static_cast<uint8_t>(bit % 8);
  return ref;
}

Ref intRef(uint32_t space, uint32_t byte, uint32_t width) {
  Ref ref;
  ref.space = space;
  ref.byte = byte;
  ref.width = static_cast<uint8_t>(width);
  ref.kind = RefKind::Int;
  return ref;
}

Ref realRef(uint32_t space, uint32_t byte) {
  Ref ref = intRef(space, byte, 64);
  ref.kind = RefKind::Real;
  return ref;
}

Ref refOf(const rung_symbol& symbol) {
  Ref ref;
  ref.readonly = (symbol.flags & RUNG_SYMBOL_READONLY) != 0;
  if ((symbol.flags & RUNG_SYMBOL_CONST) != 0) {
    ref.kind = RefKind::Constant;
    ref.width = 64;
    ref.constant = symbol.value;
    return ref;
  }
  ref.space = symbol.space;
  ref.byte = symbol.byte;
  ref.count = std::max(1u, symbol.count);
  ref.kind = RefKind::Int;
  switch (static_cast<rung_type>(symbol.type)) {
  case RUNG_TYPE_BIT:
    ref.kind = RefKind::Bit;
    ref.bit = static_cast<uint8_t>(symbol.bit);
    break;
  case RUNG_TYPE_I8: ref.width = 8; break;
  case RUNG_TYPE_I16: ref.width = 16; break;
  case RUNG_TYPE_I32: ref.width = 32; break;
  case RUNG_TYPE_I64: ref.width = 64; break;
  case RUNG_TYPE_F64:
    ref.width = 64;
    ref.kind = RefKind::Real;
    break;
  case RUNG_TYPE_TEXT:
    ref.width = 8;
    ref.kind = RefKind::Text;
    break;
  }
  return ref;
}

std::optional<Ref> element(const Ref& array, uint32_t index) {
  if (index >= array.count || array.kind == RefKind::Constant) return std::nullopt;
  Ref ref = array;
  ref.count = 1;
  switch (array.kind) {
  case RefKind::Bit: { // bits of an array are adjacent
    ref = bitRef(array.space, array.byte, array.bit + index);
    ref.readonly = array.readonly;
    return ref;
  }
  case RefKind::Text: ref.kind = RefKind::Int; break; // a byte of it
  case RefKind::Int:
  case RefKind::Real:
  case RefKind::Constant: break;
  }
  ref.byte = array.byte + index * (array.width / 8u);
  return ref;
}

std::optional<Ref> bitOf(const Ref& cell, uint32_t number) {
  if (cell.kind != RefKind::Int || number >= cell.width) return std::nullopt;
  Ref ref = bitRef(cell.space, cell.byte, number);
  ref.readonly = cell.readonly;
  return ref;
}

std::optional<Ref> asReal(const core::Memory& memory, const Ref& ref) {
  if (ref.kind != RefKind::Int && ref.kind != RefKind::Real) return std::nullopt;
  if (!memory.contains(ref.space, ref.byte, 8)) return std::nullopt;
  const bool twoWords = ref.width == 32 && memory.program().spaces[ref.space].unit_bytes == 4;
  if (ref.width != 64 && !twoWords) return std::nullopt;
  Ref real = realRef(ref.space, ref.byte);
  real.readonly = ref.readonly;
  return real;
}

core::Place locate(const core::Memory& memory, const Ref& ref) {
  if (ref.kind == RefKind::Constant) return {};
  if (ref.kind == RefKind::Bit) return memory.locateBit(ref.space, ref.byte, ref.bit);
  core::Place place = memory.locate(ref.space, ref.byte, ref.width / 8u);
  place.real = ref.kind == RefKind::Real;
  return place;
}

uint64_t readRaw(const core::Memory& memory, const Ref& ref) {
  return ref.kind == RefKind::Constant ? static_cast<uint64_t>(ref.constant) : memory.read(locate(memory, ref));
}

int64_t readSigned(const core::Memory& memory, const Ref& ref) {
  if (ref.kind == RefKind::Int) return memory.readSigned(locate(memory, ref));
  return static_cast<int64_t>(readRaw(memory, ref));
}

double readReal(const core::Memory& memory, const Ref& ref) {
  if (ref.kind == RefKind::Constant) return static_cast<double>(ref.constant);
  return memory.readReal(locate(memory, ref));
}

std::string readText(const core::Memory& memory, const Ref& ref) {
  std::string text;
  for (uint32_t i = 0; i < ref.count; ++i) {
    const uint8_t c = memory.readByte(ref.space, ref.byte + i);
    if (c == 0) break;
    text.push_back(static_cast<char>(c));
  }
  return text;
}

void writeRaw(const core::Memory& memory, const Ref& ref, uint64_t value) { memory.write(locate(memory, ref), value); }

void writeReal(const core::Memory& memory, const Ref& ref, double value) {
  if (ref.kind != RefKind::Text) memory.writeReal(locate(memory, ref), value);
}

void writeText(const core::Memory& memory, const Ref& ref, std::string_view text) {
  if (ref.kind != RefKind::Text && ref.kind != RefKind::Int) return;
  for (uint32_t i = 0; i < ref.count; ++i)
    memory.writeByte(ref.space, ref.byte + i, i < text.size() ? static_cast<uint8_t>(text[i]) : 0);
}

} // namespace rung::runtime
