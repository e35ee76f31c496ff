// Copying along a connection (see wire.h).
#include "sim/technol/wire.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rung::sim::technol {
namespace {

bool isSigned(nc::ExchangeType type) {
  return type == nc::ExchangeType::Int8 || type == nc::ExchangeType::Int16 || type == nc::ExchangeType::Int32 ||
         type == nc::ExchangeType::Int64;
}

uint64_t extended(uint64_t bits, nc::ExchangeType type) {
  const uint32_t width = widthOf(type);
  if (width == 64) return bits;
  const uint64_t value = bits & ((uint64_t{1} << width) - 1);
  const uint64_t sign = uint64_t{1} << (width - 1);
  return isSigned(type) ? (value ^ sign) - sign : value;
}

double realOf(uint64_t bits, nc::ExchangeType type) {
  if (type == nc::ExchangeType::Real) return std::bit_cast<double>(bits);
  const uint64_t value = extended(bits, type);
  return type == nc::ExchangeType::Uns64 ? static_cast<double>(value)
                                         : static_cast<double>(static_cast<int64_t>(value));
}

// To the nearest integer, to the even one of two; held in the type's range. No number is 0.
uint64_t integerOf(double value, nc::ExchangeType type) {
  const int bits = static_cast<int>(widthOf(type)) - (isSigned(type) ? 1 : 0);
  const double end = std::ldexp(1.0, bits), rounded = std::nearbyint(value);
  if (std::isnan(value)) return 0;
  if (rounded >= end) return bits == 64 ? UINT64_MAX : (uint64_t{1} << bits) - 1;
  if (isSigned(type)) return static_cast<uint64_t>(static_cast<int64_t>(std::max(rounded, -end)));
  return rounded <= 0 ? 0 : static_cast<uint64_t>(rounded);
}

double through(const Stage& stage, double x) {
  x = (std::min(std::max(x, stage.least), stage.most) + stage.before) * stage.scale + stage.after;
  return std::min(std::max(x, stage.low), stage.high);
}

uint64_t converted(const Wire& wire, uint64_t bits) {
  const nc::ExchangeType from = wire.from.type, to = wire.to.type;
  if (from == nc::ExchangeType::Bit && wire.invert) bits ^= 1;
  const bool numeric = wire.stageCount > 0 || from == nc::ExchangeType::Real || to == nc::ExchangeType::Real;
  if (!numeric) {
    if (to != nc::ExchangeType::Bit) return extended(bits, from);
    return (extended(bits, from) != 0) != (wire.invert && from != nc::ExchangeType::Bit) ? 1 : 0;
  }
  double value = realOf(bits, from);
  for (uint8_t i = 0; i < wire.stageCount; ++i) value = through(wire.stages[i], value);
  if (to == nc::ExchangeType::Bit) return (value != 0) != (wire.invert && from != nc::ExchangeType::Bit) ? 1 : 0;
  return to == nc::ExchangeType::Real ? std::bit_cast<uint64_t>(value) : integerOf(value, to);
}

} // namespace

Pin pinAt(const rung_program& program, const runtime::Ref& place, nc::ExchangeType type) {
  const core::Memory memory(program, nullptr); // for its places only
  Pin pin{.type = type, .place = place};
  if (place.kind == runtime::RefKind::Text)
    pin.kind = Pin::Kind::Text;
  else if (place.kind == runtime::RefKind::Bit)
    pin.located = memory.locateBit(place.space, place.byte, place.bit);
  else
    pin.located = memory.locate(place.space, place.byte, bytesOf(type));
  return pin;
}

uint64_t WireMemory::read(const Pin& pin) const {
  switch (pin.kind) {
  case Pin::Kind::Memory: return memory_.read(pin.located);
  case Pin::Kind::Cell: return cells_->at(pin.cell).bits;
  case Pin::Kind::CellBit: return cells_->at(pin.cell).bits >> pin.bit & 1;
  case Pin::Kind::Text: return 0;
  }
  return 0;
}

void WireMemory::write(const Pin& pin, uint64_t bits) const {
  switch (pin.kind) {
  case Pin::Kind::Memory: memory_.write(pin.located, pin.located.width() == 1 ? bits != 0 : bits); return;
  case Pin::Kind::Cell: {
    const uint32_t width = widthOf(pin.type);
    cells_->at(pin.cell).bits = width == 64 ? bits : bits & ((uint64_t{1} << width) - 1);
    return;
  }
  case Pin::Kind::CellBit: {
    uint64_t& cell = cells_->at(pin.cell).bits;
    cell = (cell & ~(uint64_t{1} << pin.bit)) | uint64_t{bits != 0} << pin.bit;
    return;
  }
  case Pin::Kind::Text: return;
  }
}

// As far as the target holds it; the last byte of a text is its terminator.
void WireMemory::copyText(const Wire& wire) const {
  const runtime::Ref &from = wire.from.place, &to = wire.to.place;
  const bool terminated = wire.to.type == nc::ExchangeType::Text;
  const uint32_t room = terminated ? to.count - 1 : to.count;
  for (uint32_t i = 0; i < to.count; ++i) {
    const uint8_t byte = i < room && i < from.count ? memory_.readByte(from.space, from.byte + i) : 0;
    memory_.writeByte(to.space, to.byte + i, byte);
  }
}

uint64_t WireMemory::valueOf(const Wire& wire) const { return converted(wire, read(wire.from)); }

void WireMemory::copy(const Wire& wire) const {
  if (wire.to.kind == Pin::Kind::Text) return copyText(wire);
  if (wire.isBit) {
    const bool value = ((memory_.read(wire.from.located) & 1) != 0) != wire.invert;
    if (value || !wire.joins) memory_.write(wire.to.located, value ? 1 : 0);
    return;
  }
  const uint64_t value = valueOf(wire);
  if (wire.joins && value == 0) return;
  write(wire.to, value);
}

} // namespace rung::sim::technol
