// See modbus_image.h.
#include "machine/io/connections/modbus_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <new>

namespace rung::io {

namespace {

using host::Area;

bool isRegister(Area area) { return area == Area::HoldingRegister || area == Area::InputRegister; }
uint32_t lengthOf(const ExchangedPin& pin) { return isRegister(pin.place.area) ? registersOf(pin.place.format) : 1; }

} // namespace

ModbusImage::ModbusImage(Exchange& exchange) : exchange_(exchange), inputs_(exchange.inputs().size()) {
  for (const ExchangedPin& pin : exchange.inputs()) mark(pin, true);
  for (const ExchangedPin& pin : exchange.outputs()) mark(pin, false);
  const auto size = [this](Area area) { return static_cast<int>(marks(area).size()); };
  tables_.reset(modbus_mapping_new(size(Area::Coil), size(Area::DiscreteInput), size(Area::HoldingRegister),
                                   size(Area::InputRegister)));
  if (tables_ == nullptr) throw std::bad_alloc();
  for (const ExchangedPin& pin : exchange.inputs()) set(pin, pin.place.safe);
}

void ModbusImage::mark(const ExchangedPin& pin, bool isInput) {
  std::vector<uint8_t>& places = marks(pin.place.area);
  const size_t end = pin.place.place + lengthOf(pin);
  places.resize(std::max(places.size(), end));
  for (size_t i = pin.place.place; i < end; ++i) places[i] = isInput ? kThere | kInput : kThere;
  places[pin.place.place] |= kFirst;
  places[end - 1] |= kLast;
}

Exception ModbusImage::check(const Request& request) const {
  const std::vector<uint8_t>& places = marks(request.area);
  const size_t end = size_t{request.first} + request.count;
  if (end > places.size()) return Exception::Address;
  const uint8_t wanted = request.writes ? kThere | kInput : kThere;
  const auto isGood = [wanted](uint8_t place) { return (place & wanted) == wanted; };
  if (!std::all_of(places.begin() + request.first, places.begin() + static_cast<int64_t>(end), isGood))
    return Exception::Address;
  if (!request.writes) return Exception::None;
  if ((places[request.first] & kFirst) == 0 || (places[end - 1] & kLast) == 0) return Exception::Address;
  return writesNumbers(request) ? Exception::None : Exception::Value;
}

// Whether written values are finite; the request has been checked to contain complete values.
bool ModbusImage::writesNumbers(const Request& request) const {
  if (!isRegister(request.area)) return true;
  return std::ranges::all_of(exchange_.inputs(), [&](const ExchangedPin& pin) {
    if (pin.place.area != request.area || pin.place.place < request.first ||
        pin.place.place >= request.first + request.count)
      return true;
    uint16_t registers[2] = {};
    for (uint32_t i = 0; i < lengthOf(pin); ++i) {
      const size_t at = size_t{pin.place.place - request.first + i} * 2;
      registers[i] = static_cast<uint16_t>(request.values[at] << 8 | request.values[at + 1]);
    }
    return fromRegisters(pin, registers).has_value();
  });
}

uint16_t* ModbusImage::registers(Area area) const {
  return area == Area::HoldingRegister ? tables_->tab_registers : tables_->tab_input_registers;
}

uint8_t* ModbusImage::bits(Area area) const { return area == Area::Coil ? tables_->tab_bits : tables_->tab_input_bits; }

void ModbusImage::set(const ExchangedPin& pin, double value) {
  if (isRegister(pin.place.area))
    toRegisters(pin, value, registers(pin.place.area) + pin.place.place);
  else
    bits(pin.place.area)[pin.place.place] = value != 0 ? 1 : 0;
}

double ModbusImage::get(const ExchangedPin& pin) const {
  if (!isRegister(pin.place.area)) return bits(pin.place.area)[pin.place.place] != 0 ? 1 : 0;
  return fromRegisters(pin, registers(pin.place.area) + pin.place.place).value_or(pin.place.safe);
}

void ModbusImage::refreshOutputs() {
  const std::vector<double>& values = exchange_.newestOutputs();
  for (size_t i = 0; i < values.size(); ++i) set(exchange_.outputs()[i], values[i]);
}

const std::vector<double>& ModbusImage::inputs() {
  for (size_t i = 0; i < inputs_.size(); ++i) inputs_[i] = get(exchange_.inputs()[i]);
  return inputs_;
}

void ModbusImage::resetInputs() {
  for (const ExchangedPin& pin : exchange_.inputs())
    if (!pin.place.holds) set(pin, pin.place.safe);
}

// The numbers are those of the "MODBUS Application Protocol Specification V1.1b3".

namespace {

using host::Area;

constexpr size_t kPrefix = 6;     // header bytes that the length does not include
constexpr size_t kHeader = 7;     // including the unit
constexpr uint8_t kAnswers = 128; // function codes from here on are answers
constexpr uint32_t kPlaces = 65536;

enum class Shape : uint8_t { Range, One, Many };

struct Function {
  uint8_t code;
  Area area;
  Shape shape;
  uint32_t most; // addresses
};

constexpr Function kFunctions[] = {
    {1, Area::Coil, Shape::Range, 2000},
    {2, Area::DiscreteInput, Shape::Range, 2000},
    {3, Area::HoldingRegister, Shape::Range, 125},
    {4, Area::InputRegister, Shape::Range, 125},
    {5, Area::Coil, Shape::One, 1},
    {6, Area::HoldingRegister, Shape::One, 1},
    {15, Area::Coil, Shape::Many, 1968},
    {16, Area::HoldingRegister, Shape::Many, 123},
};

uint32_t wordAt(std::span<const uint8_t> bytes, size_t at) { return uint32_t{bytes[at]} << 8 | bytes[at + 1]; }

// Contents: address, value.
Exception parseOne(std::span<const uint8_t> words, const Function& function, Request& request) {
  if (words.size() != 4) return Exception::Value;
  const uint32_t value = wordAt(words, 2);
  if (function.area == Area::Coil && value != 0 && value != 0xFF00) return Exception::Value;
  request.count = 1;
  request.values = words.subspan(2);
  return Exception::None;
}

// Contents: address, count; for Many, also the number of bytes and the bytes.
Exception parseRange(std::span<const uint8_t> words, const Function& function, Request& request) {
  const bool isMany = function.shape == Shape::Many;
  const size_t before = isMany ? 5 : 4;
  if (words.size() < before) return Exception::Value;
  request.count = wordAt(words, 2);
  if (request.count == 0 || request.count > function.most) return Exception::Value;
  request.values = words.subspan(before);
  const size_t wanted = function.area == Area::Coil ? (request.count + 7) / 8 : size_t{request.count} * 2;
  const bool isWhole = isMany ? words[4] == wanted && request.values.size() == wanted : request.values.empty();
  return isWhole ? Exception::None : Exception::Value;
}

} // namespace

std::optional<size_t> messageLength(std::span<const uint8_t> bytes) {
  if (bytes.size() < kPrefix) return 0;
  const size_t length = wordAt(bytes, 4);
  const bool isRequest = bytes.size() <= kHeader || bytes[kHeader] < kAnswers;
  if (wordAt(bytes, 2) != 0 || length < 2 || kPrefix + length > kLongestMessage || !isRequest) return std::nullopt;
  return kPrefix + length;
}

Exception parseRequest(std::span<const uint8_t> message, Request& request) {
  const auto* const function = std::ranges::find(kFunctions, message[kHeader], &Function::code);
  if (function == std::end(kFunctions)) return Exception::Function;
  const std::span<const uint8_t> words = message.subspan(kHeader + 1);
  if (words.size() < 4) return Exception::Value;
  request.area = function->area;
  request.writes = function->shape != Shape::Range;
  request.first = wordAt(words, 0);
  const Exception wrong =
      function->shape == Shape::One ? parseOne(words, *function, request) : parseRange(words, *function, request);
  if (wrong != Exception::None) return wrong;
  return request.first + request.count > kPlaces ? Exception::Address : Exception::None;
}

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

// Limits a number to the type of the pin.
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

// The nearest finite 32-bit value, because the other side would not accept infinity as a number.
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
