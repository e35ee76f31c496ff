// Finds what lies at a place in a list that is sorted by place.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>

#include "ir/core/memory_use.h"

namespace rung::report {

// What such a list is sorted by first.
inline std::pair<uint32_t, uint32_t> startOf(const ir::BitRange& place) { return {place.space.index, place.first}; }

// Calls `visit` with each item of `sorted` that has a bit in common with `place`, in their order. `placeOf` is an
// item's place; none has more than `longest` bits.
template <class Items, class PlaceOf, class Visit>
void forEachAt(const ir::BitRange& place, const Items& sorted, uint32_t longest, PlaceOf placeOf, Visit visit) {
  const std::pair earliest{place.space.index, place.first - std::min(place.first, longest)};
  const std::pair end{place.space.index, place.first + place.count};
  const auto start = [&](const auto& item) { return startOf(placeOf(item)); };
  for (auto at = std::ranges::lower_bound(sorted, earliest, {}, start); at != sorted.end() && start(*at) < end; ++at)
    if (ir::overlap(placeOf(*at), place)) visit(*at);
}

} // namespace rung::report
