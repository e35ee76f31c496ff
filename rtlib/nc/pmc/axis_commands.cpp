// See axis_commands.h.
#include "rtlib/nc/pmc/axis_commands.h"

#include <algorithm>

namespace rung::nc::pmc {

static_assert(std::ranges::is_sorted(axisCommandsWith({}), std::ranges::less_equal{}, &AxisCommand::code),
              "an axis command is out of order");

const AxisCommand* findAxisCommand(std::span<const AxisCommand> table, uint64_t code) {
  const auto found = std::ranges::lower_bound(table, code, {}, &AxisCommand::code);
  return found != table.end() && found->code == code ? &*found : nullptr;
}

} // namespace rung::nc::pmc
