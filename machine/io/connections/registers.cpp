// See registers.h.
#include "machine/io/connections/registers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace rung::io {
namespace {

using host::Format;
using host::PinType;

template <class Integer>
Integer limited(double value) noexcept {
  if (std::isnan(value)) return 0;
  using Limits = std::numeric_limits<Integer>;
  return static_cast<Integer>(
      std::clamp(std::round(value), static_cast<double>(Limits::min()), static_cast<double>(Limits::max())));
}

// What the pin's type holds of a number.
double held(PinType type, double value) noexcept {
  switch (type) {
  case PinType::Bit: return value != 0 ? 1 : 0;
  case PinType::S32: return limited<int32_t>(value);
  case PinType::U32: return limited<uint32_t>(value);
  case PinType::Float: return value;
  }
  return 0;
}

template <class T>
void store(uint8_t* bytes, T value) noexcept {
  std::memcpy(bytes, &value, sizeof value);
}

template <class T>
T load(const uint8_t* bytes) noexcept {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// A finite value of 32 bits: what is larger is not a number for the other side.
uint32_t floatBits(double value) noexcept {
  constexpr double kMost = std::numeric_limits<float>::max();
  return std::bit_cast<uint32_t>(static_cast<float>(std::isnan(value) ? 0 : std::clamp(value, -kMost, kMost)));
}

uint32_t bitsOf(Format format, double value) noexcept {
  switch (format) {
  case Format::S16: return static_cast<uint16_t>(limited<int16_t>(value));
  case Format::U16: return limited<uint16_t>(value);
  case Format::S32: return static_cast<uint32_t>(limited<int32_t>(value));
  case Format::U32: return limited<uint32_t>(value);
  case Format::F32: return floatBits(value);
  case Format::Bit:
  case Format::F64: break;
  }
  return value != 0 ? 1 : 0;
}

double valueOf(Format format, uint32_t bits) noexcept {
  switch (format) {
  case Format::S16: return static_cast<int16_t>(bits);
  case Format::S32: return static_cast<int32_t>(bits);
  case Format::F32: return std::bit_cast<float>(bits);
  case Format::U16:
  case Format::U32:
  case Format::Bit:
  case Format::F64: break;
  }
  return bits;
}

} // namespace

void toRegisters(const ExchangedPin& pin, double value, uint16_t* registers) noexcept {
  const uint32_t bits = bitsOf(pin.place.format, value);
  registers[0] = static_cast<uint16_t>(bits);
  if (registersOf(pin.place.format) == 1) return;
  registers[pin.place.lowFirst ? 0 : 1] = static_cast<uint16_t>(bits);
  registers[pin.place.lowFirst ? 1 : 0] = static_cast<uint16_t>(bits >> 16);
}

std::optional<double> fromRegisters(const ExchangedPin& pin, const uint16_t* registers) noexcept {
  uint32_t bits = registers[0];
  if (registersOf(pin.place.format) == 2)
    bits =
        pin.place.lowFirst ? uint32_t{registers[1]} << 16 | registers[0] : uint32_t{registers[0]} << 16 | registers[1];
  const double value = valueOf(pin.place.format, bits);
  return std::isfinite(value) ? std::optional(held(pin.type, value)) : std::nullopt;
}

void toBytes(const ExchangedPin& pin, double value, uint8_t* bytes) noexcept {
  switch (pin.type) {
  case PinType::Bit: return store<uint8_t>(bytes, value != 0 ? 1 : 0);
  case PinType::S32: return store(bytes, limited<int32_t>(value));
  case PinType::U32: return store(bytes, limited<uint32_t>(value));
  case PinType::Float: return store(bytes, value);
  }
}

std::optional<double> fromBytes(const ExchangedPin& pin, const uint8_t* bytes) noexcept {
  switch (pin.type) {
  case PinType::Bit: return bytes[0] != 0 ? 1 : 0;
  case PinType::S32: return load<int32_t>(bytes);
  case PinType::U32: return load<uint32_t>(bytes);
  case PinType::Float: break;
  }
  const double value = load<double>(bytes);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

} // namespace rung::io
