// The cartridge management table (see cartridge_table.h).
#include "sim/nct/cartridge_table.h"

#include <algorithm>

namespace rung::sim::nct {

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

void CartridgeTable::keep(Kept& kept) {
  kept.values(std::span(pots_));
  kept.values(std::span(serial_));
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

} // namespace rung::sim::nct
