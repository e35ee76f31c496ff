// Search of an empty pot (see cartridge_search.h).
#include "sim/nct/cartridge_search.h"

#include <algorithm>

namespace rung::sim::nct {
namespace {

// The cell next to the pot's centre on a side has distance 0. A quarter of an ellipse round the centre of the pot
// reaches into it when its nearest corner lies inside (geometry B, l.4600-4611).
bool cornerFree(uint32_t across, uint32_t along, uint32_t reachAcross, uint32_t reachAlong) {
  const double x = static_cast<double>(across) / (1.0 + reachAcross);
  const double y = static_cast<double>(along) / (1.0 + reachAlong);
  return x * x + y * y >= 1.0;
}

// Calls `visit(cell)` for each cell that a tool of the pattern takes around pot `index` (from 0).
template <class Visit>
void forCells(const CartridgeShape& shape, uint32_t index, const ToolPattern& p, Visit visit) {
  const int64_t width = int64_t{2} * shape.columns;
  const int64_t height = shape.matrix ? int64_t{2} * shape.rows : 1;
  const int64_t column = int64_t{2} * (index % shape.columns);
  const int64_t row = int64_t{2} * (index / shape.columns);
  const int64_t top = shape.matrix ? row - p.up : 0;
  const int64_t bottom = shape.matrix ? row + 2 + p.down : 1;
  for (int64_t y = top; y < bottom; ++y)
    for (int64_t x = column - p.left; x < column + 2 + p.right; ++x) {
      const bool leftHalf = x <= column, upperHalf = y <= row;
      const auto across = static_cast<uint32_t>(leftHalf ? column - x : x - column - 1);
      const auto along = static_cast<uint32_t>(upperHalf ? row - y : y - row - 1);
      if (shape.matrix && p.round && cornerFree(across, along, leftHalf ? p.left : p.right, upperHalf ? p.up : p.down))
        continue;
      if (!shape.matrix)
        visit(static_cast<size_t>((x % width + width) % width)); // the ring
      else if (x >= 0 && x < width && y >= 0 && y < height)      // room beyond the edge is nobody's
        visit(static_cast<size_t>(y * width + x));
    }
}

size_t cells(const CartridgeShape& shape) {
  return size_t{2} * shape.columns * (shape.matrix ? size_t{2} * shape.rows : 1);
}

} // namespace

void PotFinder::reserve(const CartridgeTable& table) {
  size_t most = 0;
  for (uint32_t number = 1; number <= kMagazines; ++number)
    if (const CartridgeShape* shape = table.find(number)) most = std::max(most, cells(*shape));
  taken_.assign(most, 0);
}

void PotFinder::markTools(const ToolTables& tables, const CartridgeShape& shape, uint32_t moving) {
  std::ranges::fill(taken_, 0);
  for (uint32_t i = 0; i < shape.pots(); ++i) {
    const uint32_t tool = tables.cartridges.dataNumber({shape.number, shape.firstPot + i});
    if (tool != 0 && tool != moving) forCells(shape, i, tables.patternOf(tool), [&](size_t cell) { taken_[cell] = 1; });
  }
}

std::optional<PotFound> PotFinder::find(const ToolTables& tables, const PotSearch& search) {
  const CartridgeShape* shape = tables.cartridges.find(search.cartridge);
  if (shape == nullptr || !shape->magazine() || !tables.cartridges.hasPot({search.cartridge, search.start}))
    return std::nullopt;
  const ToolPattern& pattern = tables.patternOf(search.tool);
  // A tool wider than the ring itself fits nowhere.
  if (!shape->matrix && uint64_t{2} + pattern.left + pattern.right > cells(*shape)) return std::nullopt;
  markTools(tables, *shape, search.tool);
  const auto fits = [&](uint32_t index) {
    bool free = true;
    forCells(*shape, index, pattern, [&](size_t cell) { free = free && taken_[cell] == 0; });
    return free;
  };
  const auto found = nearestPlace(search.start - shape->firstPot, shape->pots(), search.direction, fits);
  if (!found) return std::nullopt;
  return PotFound{shape->firstPot + found->first, found->second};
}

} // namespace rung::sim::nct
