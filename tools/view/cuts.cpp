// Of the places for a cut in the right part of a band the one that cuts the fewest wires (see cuts.h).
#include "tools/view/cuts.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace rung::view {
namespace {

bool isSolid(const Cell& cell) { return cell.kind != Cell::Kind::Rail && cell.kind != Cell::Kind::Joint; }

// Before cells that nothing on their left reaches over.
std::vector<int> places(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& width) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < sheet.cells.size(); ++i)
    if (isSolid(sheet.cells[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return left[a] < left[b]; });
  std::vector<int> result;
  int end = 0;
  for (uint32_t cell : order) {
    if (end > 0 && end <= left[cell] && (result.empty() || result.back() < left[cell])) result.push_back(left[cell]);
    end = std::max(end, left[cell] + width[cell]);
  }
  return result;
}

// By place: how many wires a cut there cuts.
std::vector<int> wiresAt(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& places) {
  std::vector<int> wires(places.size() + 1, 0);
  const auto index = [&](uint32_t cell) {
    return std::upper_bound(places.begin(), places.end(), left[cell]) - places.begin();
  };
  for (const Row& row : sheet.rows) {
    for (size_t i = 1; i < row.stops.size(); ++i) {
      if (!row.stops[i].joined) continue;
      ++wires[static_cast<size_t>(index(row.stops[i - 1].cell))];
      --wires[static_cast<size_t>(index(row.stops[i].cell))];
    }
  }
  std::partial_sum(wires.begin(), wires.end(), wires.begin());
  return wires;
}

} // namespace

Cuts chooseCuts(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& width, int needed, int rail) {
  const std::vector<int> all = places(sheet, left, width);
  const std::vector<int> wires = wiresAt(sheet, left, all);
  Cuts cuts;
  int start = 0; // what the x of the band is less than that of the whole
  size_t at = 0;
  while (needed - start > rail) {
    size_t best = all.size();
    for (; at < all.size() && (all[at] <= start + rail - kBandEnd || best == all.size()); ++at) {
      const bool late = all[at] > start + rail / 2 + kBandEnd;
      if (best == all.size() || !late || wires[at] <= wires[best]) best = at;
    }
    if (best == all.size()) break;
    cuts.push_back(all[best]);
    start = all[best] - kBandStart;
    at = best + 1;
  }
  return cuts;
}

} // namespace rung::view
