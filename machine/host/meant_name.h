// What was meant by a name that a program does not have.
#pragma once
#include <string>
#include <string_view>

#include "rtlib/text/name_parts.h"
#include "rtlib/text/similar.h"

namespace rung::host {

// The name with the symbol that it may have meant, which the program may have; "" when none is close.
template <class Symbols, class NameOf = std::identity>
std::string meantName(std::string_view name, Symbols&& symbols, NameOf nameOf = {}) {
  const std::string_view head = text::headOf(name);
  const std::string_view symbol = text::mostSimilar(head, symbols, nameOf);
  if (symbol.empty()) return {};
  std::string meant(name);
  meant.replace(static_cast<size_t>(head.data() - name.data()), head.size(), symbol);
  return meant;
}

} // namespace rung::host
