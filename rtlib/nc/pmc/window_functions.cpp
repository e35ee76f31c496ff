// See window_functions.h.
#include "rtlib/nc/pmc/window_functions.h"

#include <algorithm>

namespace rung::nc::pmc {

const WindowFunction* findWindowFunction(std::span<const WindowFunction> table, uint64_t code) {
  const auto found = std::ranges::lower_bound(table, code, {}, &WindowFunction::code);
  return found != table.end() && found->code == code ? &*found : nullptr;
}

} // namespace rung::nc::pmc
