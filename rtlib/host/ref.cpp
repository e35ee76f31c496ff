// Typed access on top of logical bytes.
#include "rtlib/host/ref.h"

#include <bit>
#include <cmath>
#include <limits>

namespace rung::host {

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

std::optional<Ref> element(const Ref& array, uint32_t index) {
  if (index >= array.count || array.kind == RefKind::Constant) return std::nullopt;
  Ref ref = array;
  ref.count = 1;
  switch (array.kind) {
  case RefKind::Bit: { // bits of an array follow each other
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

std::optional<Ref> asReal(const rt::Memory& memory, const Ref& ref) {
  if (ref.kind != RefKind::Int && ref.kind != RefKind::Real) return std::nullopt;
  if (!memory.contains(ref.space, ref.byte, 8)) return std::nullopt;
  Ref real = realRef(ref.space, ref.byte);
  real.readonly = ref.readonly;
  return real;
}

uint64_t readRaw(const rt::Memory& memory, const Ref& ref) {
  switch (ref.kind) {
  case RefKind::Bit: return memory.readBit(ref.space, ref.byte, ref.bit) ? 1 : 0;
  case RefKind::Int:
  case RefKind::Real:
  case RefKind::Text: return memory.read(ref.space, ref.byte, ref.width / 8u);
  case RefKind::Constant: return static_cast<uint64_t>(ref.constant);
  }
  return 0;
}

int64_t readSigned(const rt::Memory& memory, const Ref& ref) {
  const uint64_t raw = readRaw(memory, ref);
  if (ref.kind != RefKind::Int) return static_cast<int64_t>(raw);
  const uint32_t unused = 64u - ref.width;
  return static_cast<int64_t>(raw << unused) >> unused;
}

double readReal(const rt::Memory& memory, const Ref& ref) {
  if (ref.kind == RefKind::Real) return std::bit_cast<double>(readRaw(memory, ref));
  return static_cast<double>(readSigned(memory, ref));
}

std::string readText(const rt::Memory& memory, const Ref& ref) {
  std::string text;
  for (uint32_t i = 0; i < ref.count; ++i) {
    const uint8_t c = memory.readByte(ref.space, ref.byte + i);
    if (c == 0) break;
    text.push_back(static_cast<char>(c));
  }
  return text;
}

void writeRaw(const rt::Memory& memory, const Ref& ref, uint64_t value) {
  switch (ref.kind) {
  case RefKind::Bit: memory.writeBit(ref.space, ref.byte, ref.bit, (value & 1) != 0); return;
  case RefKind::Int:
  case RefKind::Real:
  case RefKind::Text: memory.write(ref.space, ref.byte, ref.width / 8u, value); return;
  case RefKind::Constant: return;
  }
}

namespace {

// Rounded to nearest; NaN gives 0, what is too large the nearest end of the signed range.
int64_t saturated(double value, uint32_t width) {
  if (std::isnan(value)) return 0;
  const int64_t highest = std::numeric_limits<int64_t>::max() >> (64 - width);
  const double rounded = std::nearbyint(value);
  if (rounded >= -static_cast<double>(-highest - 1)) return highest;
  if (rounded < static_cast<double>(-highest - 1)) return -highest - 1;
  return static_cast<int64_t>(rounded);
}

} // namespace

void writeReal(const rt::Memory& memory, const Ref& ref, double value) {
  if (ref.kind == RefKind::Real) {
    writeRaw(memory, ref, std::bit_cast<uint64_t>(value));
  } else if (ref.kind == RefKind::Int) {
    writeRaw(memory, ref, static_cast<uint64_t>(saturated(value, ref.width)));
  } else if (ref.kind == RefKind::Bit) {
    writeRaw(memory, ref, value != 0 ? 1 : 0);
  }
}

void writeText(const rt::Memory& memory, const Ref& ref, std::string_view text) {
  if (ref.kind != RefKind::Text && ref.kind != RefKind::Int) return;
  for (uint32_t i = 0; i < ref.count; ++i)
    memory.writeByte(ref.space, ref.byte + i, i < text.size() ? static_cast<uint8_t>(text[i]) : 0);
}

} // namespace rung::host
