// Parts of configuration keys and their values.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "rtlib/nc/control/technol/values.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::io {

// Nothing where the text is not a number within these limits.
inline std::optional<uint32_t> numberBetween(std::string_view text, int64_t least, int64_t most) {
  const auto number = nc::technol::integerOf(text);
  return number && *number >= least && *number <= most ? std::optional(static_cast<uint32_t>(*number)) : std::nullopt;
}

// The number after a prefix, in any case, of the key: PlcTableDef3.
inline std::optional<uint32_t> numberAfter(std::string_view key, std::string_view prefix) {
  return text::takePrefixIgnoringCase(key, prefix) ? text::numberIn<uint32_t>(key) : std::nullopt;
}

// The text up to the character, which both go away from `text`; all of it where the character is not there.
inline std::string_view takeUntil(std::string_view& text, char end) {
  const size_t at = std::min(text.find(end), text.size());
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return part;
}

} // namespace rung::io
