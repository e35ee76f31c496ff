// See modbus_request.h. The numbers are those of the "MODBUS Application Protocol Specification V1.1b3".
#include "machine/io/connections/modbus_request.h"

#include <algorithm>
#include <iterator>

namespace rung::io {
namespace {

using host::Area;

constexpr size_t kPrefix = 6;     // bytes of the header that the length does not count
constexpr size_t kHeader = 7;     // with the unit
constexpr uint8_t kAnswers = 128; // from this function on
constexpr uint32_t kPlaces = 65536;

enum class Shape : uint8_t { Range, One, Many };

struct Function {
  uint8_t code;
  Area area;
  Shape shape;
  uint32_t most; // places
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

// Address, value.
Exception parseOne(std::span<const uint8_t> words, const Function& function, Request& request) {
  if (words.size() != 4) return Exception::Value;
  const uint32_t value = wordAt(words, 2);
  if (function.area == Area::Coil && value != 0 && value != 0xFF00) return Exception::Value;
  request.count = 1;
  request.values = words.subspan(2);
  return Exception::None;
}

// Address, count; of Many how many bytes follow, and these.
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

} // namespace rung::io
