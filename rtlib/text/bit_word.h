// A bit as a word, as people write it in scenarios and on command lines.
#pragma once
#include <optional>
#include <string_view>

#include "rtlib/text/letters.h"

namespace rung::text {

// on, true, off and false, in capitals, too; nothing: it is another word.
constexpr std::optional<bool> bitWord(std::string_view word) {
  if (equalsIgnoringCase(word, "on") || equalsIgnoringCase(word, "true")) return true;
  if (equalsIgnoringCase(word, "off") || equalsIgnoringCase(word, "false")) return false;
  return std::nullopt;
}

} // namespace rung::text
