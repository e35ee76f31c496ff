// The cartridge management table (man. 6.26.2, l.4443-4497): which tool, by its data number, is in which pot.
// Cartridges 1-4 are magazines, 10 * s is spindle s and 10 * s + 1 its standby cartridge, both of one pot.
//
// Invariant: a data number is in one pot at most.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/nct/kept.h"

namespace rung::sim::nct {

inline constexpr uint32_t kMagazines = 4;

// A cartridge of the chain type is a ring of one row; the pots of a matrix are counted row by row.
struct CartridgeShape {
  uint32_t number = 0;
  uint32_t firstPot = 1;
  uint32_t columns = 1;
  uint32_t rows = 1;
  bool matrix = false;

  uint32_t pots() const { return columns * rows; }
  bool magazine() const { return number <= kMagazines; }
};

struct PotPlace {
  uint32_t cartridge = 0;
  uint32_t pot = 0;
  bool operator==(const PotPlace&) const = default;
};

class CartridgeTable {
public:
  // All pots are empty. `shapes` in the order of the table's rows, each number once; data numbers go from 1 to
  // `dataNumbers`. Nothing else allocates.
  void build(std::span<const CartridgeShape> shapes, uint32_t dataNumbers);
  void clear();

  uint32_t size() const { return static_cast<uint32_t>(pots_.size()); } // rows of the table: serial numbers 1 to size
  PotPlace place(uint32_t serial) const;

  const CartridgeShape* find(uint32_t cartridge) const;
  bool hasPot(PotPlace place) const { return index(place).has_value(); }

  // 0: no tool, or no such pot.
  uint32_t dataNumber(PotPlace place) const;
  // A pot that holds the number already gives it away.
  void put(PotPlace place, uint32_t dataNumber);
  void exchange(PotPlace first, PotPlace second);
  std::optional<PotPlace> placeOf(uint32_t dataNumber) const;
  void take(uint32_t dataNumber); // out of its pot
  void keep(Kept& kept);

private:
  struct Cartridge {
    CartridgeShape shape;
    uint32_t first = 0; // of its pots in pots_
  };
  std::optional<uint32_t> index(PotPlace place) const;
  void write(uint32_t index, uint32_t dataNumber);

  std::vector<Cartridge> cartridges_;
  std::vector<uint32_t> pots_;   // data numbers
  std::vector<uint32_t> serial_; // by data number: row of its pot, from 1; 0: in none
};

} // namespace rung::sim::nct
