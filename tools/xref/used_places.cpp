// See used_places.h.
#include "tools/xref/used_places.h"

#include <algorithm>
#include <tuple>

namespace rung::xref {
namespace {

// Where a user would look: a latch that the compiler made shows under the name of what it was copied from.
ir::BitRange namedPlace(const rung_program& program, const ir::Uses& uses, const ir::BitRange& place) {
  if ((program.spaces[place.space.index].flags & RUNG_SPACE_HIDDEN) == 0) return place;
  const std::vector<ir::BitRange> from = uses.copiedFrom(place);
  return from.empty() ? place : from[0];
}

} // namespace

std::vector<UsedPlace> usedPlaces(const rung_program& program, const ir::Uses& uses) {
  std::vector<UsedPlace> all;
  for (uint32_t rung = 0; rung < uses.rungCount(); ++rung)
    for (ir::Use use : uses.of(rung)) {
      use.place = namedPlace(program, uses, use.place);
      const bool hidden = (program.spaces[use.place.space.index].flags & RUNG_SPACE_HIDDEN) != 0;
      if (!use.computed && !hidden) all.push_back({use, !use.writes, use.writes});
    }
  const auto order = [](const UsedPlace& place) {
    const ir::BitRange& bits = place.use.place;
    return std::tuple(bits.space.index, bits.first, bits.count, static_cast<int>(place.use.type));
  };
  std::ranges::sort(all, {}, order);
  std::vector<UsedPlace> places;
  for (const UsedPlace& place : all) {
    if (places.empty() || order(places.back()) != order(place)) places.push_back(place);
    places.back().read |= place.read;
    places.back().written |= place.written;
  }
  return places;
}

} // namespace rung::xref
