// See used_places.h.
#include "tools/xref/used_places.h"

#include <algorithm>
#include <tuple>

#include "tools/xref/place_names.h"

namespace rung::xref {
std::vector<UsedPlace> usedPlaces(const rung_program& program, const ir::Uses& uses) {
  std::vector<UsedPlace> all;
  for (uint32_t rung = 0; rung < uses.rungCount(); ++rung)
    for (ir::Use use : uses.of(rung)) {
      const std::optional<ir::BitRange> known = knownPlace(program, uses, use.place);
      if (use.computed || !known) continue;
      use.place = *known;
      all.push_back({use, !use.writes, use.writes});
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
