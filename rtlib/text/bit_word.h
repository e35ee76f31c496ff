// The value of a bit as a word, as in scenarios and on command lines.
#pragma once
#include <optional>
#include <string_view>

#include "rtlib/text/letters.h"

namespace rung::text {

// on, true, off or false, in any case; nothing for any other word.
constexpr std::optional<bool> bitWord(std::string_view word) {
  if (equalsIgnoringCase(word, "on") || equalsIgnoringCase(word, "true")) return true;
  if (equalsIgnoringCase(word, "off") || equalsIgnoringCase(word, "false")) return false;
  return std::nullopt;
}

} // namespace rung::text
