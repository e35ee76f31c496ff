// The display (see handwheel_display.h).
#include "sim/technol/devices/handwheel_display.h"

#include <algorithm>

namespace rung::sim::technol {
namespace {

constexpr uint32_t kCharacters = 4;
constexpr uint8_t kStays = 0xFF;
constexpr uint32_t kSizes = 2;

constexpr uint32_t widthOf(uint8_t size) { return size == 0 ? 6 : 12; }
constexpr uint32_t heightOf(uint8_t size) { return size == 0 ? 8 : 16; }
constexpr uint32_t kMostWidth = widthOf(1), kMostHeight = heightOf(1);

} // namespace

void HandwheelDisplay::clear() {
  cells_ = {};
  last_ = {};
}

void HandwheelDisplay::show(std::span<const uint8_t, 8> order) {
  if (std::equal(order.begin(), order.end(), last_.begin())) return; // nobody else writes there
  std::copy(order.begin(), order.end(), last_.begin());
  const uint8_t size = order[6];
  if (size >= kSizes) return;
  for (uint32_t i = 0; i < kCharacters; ++i)
    if (order[2 + i] != kStays) put(order[0], order[1] + i * widthOf(size), {order[2 + i], size, order[7] != 0});
}

// Characters that it overlaps are gone.
void HandwheelDisplay::put(uint32_t row, uint32_t column, const Cell& cell) {
  const uint32_t bottom = row + heightOf(cell.size), right = column + widthOf(cell.size);
  if (bottom > kRows || right > kColumns) return;
  for (uint32_t r = row < kMostHeight ? 0 : row - kMostHeight; r < bottom; ++r)
    for (uint32_t c = column < kMostWidth ? 0 : column - kMostWidth; c < right; ++c) {
      Cell& old = cells_[r][c];
      if (r + heightOf(old.size) > row && c + widthOf(old.size) > column) old = {};
    }
  cells_[row][column] = cell;
}

std::string HandwheelDisplay::text(uint32_t row, uint32_t column) const {
  std::string shown;
  while (row < kRows && column < kColumns && cells_[row][column].character != 0) {
    const Cell& cell = cells_[row][column];
    shown += static_cast<char>(cell.character);
    column += widthOf(cell.size);
  }
  return shown;
}

} // namespace rung::sim::technol
