// Names as scenarios write them.
#pragma once
#include <string_view>

#include "rtlib/text/letters.h"

namespace rung::sim::technol {

// `prefix` in any case at the beginning of the text, which loses it.
inline bool takeAnyCase(std::string_view& text, std::string_view prefix) {
  if (!text::equalsIgnoringCase(text.substr(0, prefix.size()), prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

} // namespace rung::sim::technol
