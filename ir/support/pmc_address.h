// Addresses of a FANUC PMC as its files write them: X8.4, G0008.4, D100, P0005, 2:R10.0.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "rtlib/text/letters.h"

namespace rung {

struct PmcAddress {
  uint32_t pmc = 1;            ///< the PMC of a control that has several: `2:` or `2` before the area
  char area = 'R';             ///< a capital letter
  uint32_t number = 0;         ///< of the byte; at most 99999
  std::optional<uint32_t> bit; ///< 0 to 7
};

namespace detail {

/// Takes the digits at the beginning of the text; nothing if there are none, or more than six.
constexpr std::optional<uint32_t> takeDigits(std::string_view& text) {
  uint32_t number = 0;
  size_t count = 0;
  while (count < text.size() && text::isDigit(text[count]) && count < 7)
    number = number * 10 + static_cast<uint32_t>(text[count++] - '0');
  if (count == 0 || count == 7) return std::nullopt;
  text.remove_prefix(count);
  return number;
}

} // namespace detail

/// Nothing if the text is not an address. Whether a control has it depends on its type.
constexpr std::optional<PmcAddress> pmcAddress(std::string_view text) {
  PmcAddress address;
  if (!text.empty() && text[0] >= '1' && text[0] <= '9') {
    address.pmc = static_cast<uint32_t>(text[0] - '0');
    text.remove_prefix(text.size() > 1 && text[1] == ':' ? 2 : 1);
  }
  constexpr std::string_view kAreas = "XYFGRAKTCDEZMNPL";
  if (text.empty() || kAreas.find(text::upper(text[0])) == std::string_view::npos) return std::nullopt;
  address.area = text::upper(text[0]);
  text.remove_prefix(1);
  const std::optional<uint32_t> number = detail::takeDigits(text);
  if (!number || *number > 99999) return std::nullopt;
  address.number = *number;
  if (text.empty()) return address;
  if (text.size() != 2 || text[0] != '.' || text[1] < '0' || text[1] > '7') return std::nullopt;
  address.bit = static_cast<uint32_t>(text[1] - '0');
  return address;
}

} // namespace rung
