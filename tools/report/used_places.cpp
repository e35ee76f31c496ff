// See used_places.h.
#include "tools/report/used_places.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "tools/report/place_names.h"

namespace rung::report {
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

PlaceSet::PlaceSet(std::vector<ir::BitRange> places) {
  const auto order = [](const ir::BitRange& bits) { return std::pair(bits.space.index, bits.first); };
  std::ranges::sort(places, {}, order);
  for (const ir::BitRange& bits : places) {
    const bool touches = !places_.empty() && places_.back().space == bits.space &&
                         bits.first <= places_.back().first + places_.back().count;
    if (!touches) places_.push_back(bits);
    ir::BitRange& last = places_.back();
    last.count = std::max(last.count, bits.first + bits.count - last.first);
  }
}

bool PlaceSet::meets(const ir::BitRange& place) const {
  const auto order = [](const ir::BitRange& bits) { return std::pair(bits.space.index, bits.first); };
  const auto after =
      std::ranges::lower_bound(places_, std::pair(place.space.index, place.first + place.count), {}, order);
  return after != places_.begin() && ir::overlap(*std::prev(after), place);
}

PlaceSet writtenPlaces(const std::vector<UsedPlace>& places) {
  std::vector<ir::BitRange> written;
  for (const UsedPlace& place : places)
    if (place.written) written.push_back(place.use.place);
  return PlaceSet(std::move(written));
}

} // namespace rung::report
