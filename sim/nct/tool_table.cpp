// The tool management table.
#include "sim/nct/tool_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::sim::nct {

namespace {

constexpr std::string_view kNames[] = {"TYPE", "INFO", "FIGURE", "STATUS", "COUNTER", "LIFE", "NOTICE",
                                       "H",    "D",    "G",      "W",      "S",       "F"};
constexpr int32_t kMaxType = 99'999'999; // 8 digits, l.4338

} // namespace

ToolColumn toolColumn(std::string_view name) {
  const std::string wanted = text::upper(name);
  const auto found = std::ranges::find(kNames, std::string_view(wanted));
  if (found != std::end(kNames)) return static_cast<ToolColumn>(found - std::begin(kNames)) + 1;
  if (!wanted.starts_with("USER")) return 0;
  const std::optional<uint32_t> user = text::numberIn<uint32_t>(std::string_view(wanted).substr(4));
  return user && *user >= 1 && *user <= kToolUserColumns ? kToolUser1 + *user - 1 : 0;
}

bool ToolRow::searchable() const {
  if (!valid() || words_[kToolType] == 0) return false;
  switch (status()) {
  case kLifeNotPerformed: return info(kInfoSearchable);
  case kLifeNotUsed:
  case kLifeUsed: return true;
  default: return false;
  }
}

void ToolRow::renewStatus() {
  if (!hasLife()) return;
  const int32_t counter = words_[kToolCounter];
  words_[kToolStatus] = counter >= words_[kToolLife] ? kLifeExpired : counter == 0 ? kLifeNotUsed : kLifeUsed;
}

bool acceptable(ToolColumn column, const ToolDatum& datum, const ToolLimits& limits) {
  const int32_t word = datum.word;
  if (column == kToolFeed) return std::isfinite(datum.real) && datum.real >= 0;
  if (isRealColumn(column)) return std::isfinite(datum.real);
  if (word < 0) return false;
  switch (column) {
  case kToolType: return word >= 1 && word <= kMaxType;
  case kToolInfo: return static_cast<uint32_t>(word) <= kInfoBits;
  case kToolFigure: return word <= 20;
  case kToolStatus: return word <= kLifeBroken;
  case kToolH:
  case kToolD:
  case kToolG:
  case kToolW: return static_cast<uint32_t>(word) <= limits.compensations;
  case kToolUser1: return word <= 0xFF;
  default: return true;
  }
}

std::optional<ToolColumn> columnsOfRecord(int64_t words, uint32_t userColumns) {
  int64_t end = 0;
  for (ToolColumn column = kToolType; column <= kToolFeed + userColumns; ++column) {
    end += columnWords(column);
    if (end == words) return column;
  }
  return std::nullopt;
}

uint32_t ToolTable::firstFree() const {
  for (uint32_t i = 1; i <= size(); ++i)
    if (!rows_[i].valid()) return i;
  return 0;
}

// The tables of the tool management.

const ToolPattern& ToolTables::patternOf(uint32_t dataNumber) const {
  const bool large = tools.has(dataNumber) && tools.row(dataNumber).info(kInfoLarge);
  return patterns.row(large ? static_cast<uint32_t>(tools.row(dataNumber).word(kToolFigure)) : 0);
}

ToolPick ToolTables::pick(int32_t type) const {
  ToolPick best;
  best.expired = groupExpired(type);
  for (uint32_t i = 1; i <= tools.size(); ++i) {
    const ToolRow& row = tools.row(i);
    if (row.word(kToolType) != type || !row.searchable()) continue;
    if (best.dataNumber != 0 && row.word(kToolCounter) <= tools.row(best.dataNumber).word(kToolCounter)) continue;
    const std::optional<PotPlace> place = cartridges.placeOf(i);
    if (!place) continue;
    best.dataNumber = i;
    best.place = *place;
  }
  return best;
}

bool ToolTables::groupExpired(int32_t type) const {
  bool over = false;
  for (uint32_t i = 1; i <= tools.size(); ++i) {
    const ToolRow& row = tools.row(i);
    if (!row.valid() || row.word(kToolType) != type) continue;
    if (row.searchable()) return false;
    over = over || row.status() == kLifeExpired || row.status() == kLifeBroken;
  }
  return over;
}

void ToolTables::remove(uint32_t dataNumber) {
  tools.clear(dataNumber);
  cartridges.take(dataNumber);
}

// The cartridge management table.

void CartridgeTable::build(std::span<const CartridgeShape> shapes, uint32_t dataNumbers) {
  cartridges_.clear();
  uint32_t pots = 0;
  for (const CartridgeShape& shape : shapes) {
    cartridges_.push_back({shape, pots});
    pots += shape.pots();
  }
  pots_.assign(pots, 0);
  serial_.assign(dataNumbers + size_t{1}, 0);
}

void CartridgeTable::retain(Retained& retained) {
  retained.values(std::span(pots_));
  retained.values(std::span(serial_));
}

void CartridgeTable::clear() {
  std::ranges::fill(pots_, 0);
  std::ranges::fill(serial_, 0);
}

const CartridgeShape* CartridgeTable::find(uint32_t cartridge) const {
  for (const Cartridge& c : cartridges_)
    if (c.shape.number == cartridge) return &c.shape;
  return nullptr;
}

std::optional<uint32_t> CartridgeTable::index(PotPlace place) const {
  for (const Cartridge& c : cartridges_) {
    if (c.shape.number != place.cartridge) continue;
    if (place.pot < c.shape.firstPot || place.pot - c.shape.firstPot >= c.shape.pots()) return std::nullopt;
    return c.first + (place.pot - c.shape.firstPot);
  }
  return std::nullopt;
}

PotPlace CartridgeTable::place(uint32_t serial) const {
  for (const Cartridge& c : cartridges_)
    if (serial > c.first && serial <= c.first + c.shape.pots())
      return {c.shape.number, c.shape.firstPot + (serial - 1 - c.first)};
  return {};
}

uint32_t CartridgeTable::dataNumber(PotPlace place) const {
  const std::optional<uint32_t> at = index(place);
  return at ? pots_[*at] : 0;
}

void CartridgeTable::write(uint32_t index, uint32_t dataNumber) {
  pots_[index] = dataNumber;
  if (dataNumber != 0) serial_[dataNumber] = index + 1;
}

void CartridgeTable::put(PotPlace place, uint32_t dataNumber) {
  const std::optional<uint32_t> at = index(place);
  if (!at || dataNumber >= serial_.size()) return;
  take(dataNumber);
  take(pots_[*at]);
  write(*at, dataNumber);
}

void CartridgeTable::exchange(PotPlace first, PotPlace second) {
  const std::optional<uint32_t> a = index(first);
  const std::optional<uint32_t> b = index(second);
  if (!a || !b) return;
  const uint32_t moved = pots_[*a];
  write(*a, pots_[*b]);
  write(*b, moved);
}

std::optional<PotPlace> CartridgeTable::placeOf(uint32_t dataNumber) const {
  if (dataNumber == 0 || dataNumber >= serial_.size() || serial_[dataNumber] == 0) return std::nullopt;
  return place(serial_[dataNumber]);
}

void CartridgeTable::take(uint32_t dataNumber) {
  if (dataNumber == 0 || dataNumber >= serial_.size() || serial_[dataNumber] == 0) return;
  pots_[serial_[dataNumber] - 1] = 0;
  serial_[dataNumber] = 0;
}

// Search for an empty pot.

namespace {

// Whether the cell is outside the tool's quarter of an ellipse around the centre of the pot, which covers it if its
// nearest corner is inside (geometry B, l.4600-4611). The cell next to the pot's centre on a side has distance 0.
bool cornerFree(uint32_t across, uint32_t along, uint32_t reachAcross, uint32_t reachAlong) {
  const double x = static_cast<double>(across) / (1.0 + reachAcross);
  const double y = static_cast<double>(along) / (1.0 + reachAlong);
  return x * x + y * y >= 1.0;
}

// Calls `visit(cell)` for each cell that a tool of the pattern occupies around pot `index` (from 0).
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
      else if (x >= 0 && x < width && y >= 0 && y < height)      // cells past the edge do not exist
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
