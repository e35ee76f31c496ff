// Parses and prints addresses and numbers.
#include "frontend/network/address.h"

#include <algorithm>

#include <fmt/format.h>

#include "ir/support/saturate.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

constexpr uint64_t kSaturated = 1ull << 62;

std::optional<int64_t> parseHex(std::string_view text) {
  if (text.empty()) return std::nullopt;
  uint64_t value = 0;
  for (char c : text) {
    const int digit = text::hexDigit(c);
    if (digit < 0) return std::nullopt;
    value = std::min(saturatedSum(saturatedProduct(value, 16), static_cast<uint32_t>(digit)), kSaturated);
  }
  return static_cast<int64_t>(value);
}

std::optional<Area> findArea(const Language& language, char letter) {
  const auto at = std::ranges::find(language.areas, letter, &AreaInfo::letter);
  if (at == language.areas.end()) return std::nullopt;
  return static_cast<Area>(at - language.areas.begin());
}

} // namespace

std::string textOf(const Language& language, const Address& address) {
  const char letter = language.at(address.area).letter;
  return address.isBit ? fmt::format("{}{}.{}", letter, address.byte, address.bit)
                       : fmt::format("{}{}", letter, address.byte);
}

std::string bytesText(const AreaInfo& info) {
  if (info.bytes == 0) return fmt::format("the areas of this control, which has no {}", info.letter);
  if (info.parts.empty()) return fmt::format("{0}0 to {0}{1}", info.letter, info.bytes - 1);
  std::string text;
  for (const ByteRange& part : info.parts)
    text += fmt::format("{0}{1}{2} to {1}{3}", text.empty() ? "" : ", ", info.letter, part.first, part.last);
  return text;
}

std::optional<uint64_t> parseDigits(std::string_view text) {
  if (text.empty()) return std::nullopt;
  uint64_t value = 0;
  for (char c : text) {
    if (!text::isDigit(c)) return std::nullopt;
    value = std::min(saturatedSum(saturatedProduct(value, 10), static_cast<uint32_t>(c - '0')), kSaturated);
  }
  return value;
}

std::optional<int64_t> parseConstant(const Language& language, std::string_view text) {
  if (language.hexadecimal && text.size() > 2 && text[0] == '0' && text::upper(text[1]) == 'X')
    return parseHex(text.substr(2));
  const bool negative = text.starts_with('-');
  const auto digits = parseDigits(text.substr(negative ? 1 : 0));
  if (!digits) return std::nullopt;
  const auto value = static_cast<int64_t>(*digits);
  return negative ? -value : value;
}

std::optional<AddressText> splitAddress(const Language& language, std::string_view text) {
  if (text.size() < 2) return std::nullopt;
  const auto area = findArea(language, text::upper(text[0]));
  if (!area) return std::nullopt;
  const size_t point = text.find('.');
  const auto number = parseDigits(text.substr(1, point == std::string_view::npos ? point : point - 1));
  if (!number) return std::nullopt;
  AddressText result{*area, *number, point != std::string_view::npos, {}};
  if (result.hasPoint) result.bit = text.substr(point + 1);
  return result;
}

std::optional<Address> parseAddress(const Language& language, std::string_view text) {
  const auto split = splitAddress(language, text);
  if (!split) return std::nullopt;
  Address address{split->area, static_cast<uint32_t>(std::min<uint64_t>(split->byte, UINT32_MAX)), 0, split->hasPoint};
  if (!split->hasPoint) return address;
  if (split->bit.size() != 1 || split->bit[0] < '0' || split->bit[0] > '7') return std::nullopt;
  address.bit = static_cast<uint8_t>(split->bit[0] - '0');
  return address;
}

Address addressOf(const Language& language, const nc::Signal& signal) {
  const bool isBit = signal.type == nc::SignalType::Bit;
  return {findArea(language, signal.area[0]).value_or(Area{}), signal.byteOffset, isBit ? signal.bit : uint8_t{0},
          isBit};
}

uint32_t bytesOf(const nc::Signal& signal) { return std::max(1u, nc::elementBytes(signal.type)); }

bool covers(const Language& language, const nc::Signal& signal, const Address& address) {
  const Address own = addressOf(language, signal);
  if (own.area != address.area || address.byte < own.byte || address.byte >= own.byte + bytesOf(signal)) return false;
  return !own.isBit || !address.isBit || own.bit == address.bit;
}

} // namespace rung::frontend::network
