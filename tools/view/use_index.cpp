// Uses as drawn, and those that only the program knows (see use_index.h).
#include "tools/view/use_index.h"

#include <algorithm>

#include "tools/report/place_search.h"

namespace rung::view {

void UseIndex::settle() {
  if (longest_ != 0) return;
  longest_ = 1;
  for (const Drawn& drawn : drawn_) longest_ = std::max(longest_, drawn.place.count);
  std::ranges::stable_sort(drawn_, {}, [](const Drawn& drawn) { return report::startOf(drawn.place); });
}

std::vector<Use> UseIndex::drawnAt(const ir::BitRange& place) const {
  std::vector<Use> uses;
  report::forEachAt(
      place, drawn_, longest_, [](const Drawn& drawn) { return drawn.place; },
      [&](const Drawn& drawn) { uses.push_back(drawn.use); });
  return uses;
}

// What an operand says goes before what the program does with the place.
std::vector<Use> UseIndex::of(const ir::BitRange& place) {
  settle();
  std::vector<Use> uses = drawnAt(place);
  std::ranges::sort(uses);
  const size_t drawn = uses.size();
  for (const report::RungAccess& access : reference_.accessesOf(place)) {
    const uint32_t rung = reference_.program().rungs[access.rung].number;
    const auto first =
        std::ranges::lower_bound(uses.begin(), uses.begin() + static_cast<ptrdiff_t>(drawn), rung, {}, &Use::rung);
    const bool isDrawn = first != uses.begin() + static_cast<ptrdiff_t>(drawn) && first->rung == rung;
    if (rung == 0 || isDrawn || access.indexed) continue;
    if (access.reads) uses.push_back({rung, false});
    if (access.writes) uses.push_back({rung, true});
  }
  std::ranges::sort(uses);
  const auto again = std::ranges::unique(uses);
  uses.erase(again.begin(), again.end());
  return uses;
}

} // namespace rung::view
