// The places of the areas of a program (see signals_io.h).
#include "rtlib/nc/control/pmc/signals_io.h"

#include <span>

#include "rtlib/load/program_info.h"

namespace rung::nc::pmc {

Area::Area(const rung_program& program, std::string_view name) {
  const uint32_t number = runtime::findSpace(program, name);
  if (number == RUNG_NONE) return;
  const rung_space& space = program.spaces[number];
  places_.resize(space.byte_count);
  for (const rung_range& range : std::span(space.ranges, space.range_count)) {
    const bool expanded = range.repr == RUNG_REPR_BYTE_PER_BIT;
    for (uint32_t i = 0; i < range.byte_count; ++i)
      places_[range.first_byte + i] = {range.offset + (expanded ? 8 * i : i), expanded};
  }
}

} // namespace rung::nc::pmc
