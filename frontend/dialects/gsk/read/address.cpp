// Addresses and numbers as text.
#include "frontend/dialects/gsk/read/address.h"

#include <algorithm>

#include <fmt/format.h>

#include "ir/support/ascii.h"
#include "rtlib/text/letters.h"

namespace rung::gsk {
namespace {

constexpr uint64_t kSaturated = 1ull << 62;

std::optional<int64_t> parseHex(std::string_view text) {
  if (text.empty()) return std::nullopt;
  uint64_t value = 0;
  for (char c : text) {
    const int digit = hexDigit(c);
    if (digit < 0) return std::nullopt;
    value = std::min(value * 16 + static_cast<uint32_t>(digit), kSaturated);
  }
  return static_cast<int64_t>(value);
}

} // namespace

std::string textOf(const Address& address) {
  const char letter = areaInfo(address.area).letter;
  return address.isBit ? fmt::format("{}{}.{}", letter, address.byte, address.bit)
                       : fmt::format("{}{}", letter, address.byte);
}

std::optional<uint64_t> parseDigits(std::string_view text) {
  if (text.empty()) return std::nullopt;
  uint64_t value = 0;
  for (char c : text) {
    if (!isDigit(c)) return std::nullopt;
    value = std::min(value * 10 + static_cast<uint64_t>(c - '0'), kSaturated);
  }
  return value;
}

std::optional<int64_t> parseConstant(std::string_view text) {
  if (text.size() > 2 && text[0] == '0' && text::upper(text[1]) == 'X') return parseHex(text.substr(2));
  const bool negative = text.starts_with('-');
  const auto digits = parseDigits(text.substr(negative ? 1 : 0));
  if (!digits) return std::nullopt;
  const auto value = static_cast<int64_t>(*digits);
  return negative ? -value : value;
}

std::optional<AddressText> splitAddress(std::string_view text) {
  if (text.size() < 2) return std::nullopt;
  const char letter = text::upper(text[0]);
  const auto area = std::find_if(kAreas.begin(), kAreas.end(), [&](const AreaInfo& a) { return a.letter == letter; });
  if (area == kAreas.end()) return std::nullopt;
  const size_t point = text.find('.');
  const auto number = parseDigits(text.substr(1, point == std::string_view::npos ? point : point - 1));
  if (!number) return std::nullopt;
  AddressText result{static_cast<Area>(area - kAreas.begin()), *number, point != std::string_view::npos, {}};
  if (result.hasPoint) result.bit = text.substr(point + 1);
  return result;
}

bool touchesPreset(const Address& address, uint32_t length) {
  if (address.area == Area::T) return true;
  if (address.area != Area::C) return false;
  for (uint32_t i = 0; i < std::min(length, 4u); ++i)
    if ((address.byte + i) % 4 < 2) return true;
  return false;
}

} // namespace rung::gsk
