// Search of an empty pot for a tool (man. 6.26.3 and 6.26.5, l.4498-4718). Room is counted in cells of half a pot: a
// chain-type cartridge is a ring of cells, a matrix a field with two cells a pot in either direction. A tool fits where
// none of its cells is another tool's; half a pot that is left over takes no tool, but it takes the half of a
// neighbour.
#pragma once
#include <optional>
#include <vector>

#include "sim/nct/ring_search.h"
#include "sim/nct/tool_tables.h"

namespace rung::sim::nct {

struct PotSearch {
  uint32_t cartridge = 0;
  uint32_t start = 0; // a pot of it
  SearchDirection direction = SearchDirection::Both;
  uint32_t tool = 0; // data number of the tool that looks for a place: its own cells are free; 0: takes one pot
};

struct PotFound {
  uint32_t pot = 0;
  SearchDirection rotation = SearchDirection::Positive; // of the magazine, never Both
};

class PotFinder {
public:
  // For the largest magazine of the table; `find` does not allocate.
  void reserve(const CartridgeTable& table);
  // The nearest empty pot in the direction, the start first; of two at the same distance the one in positive direction.
  // Pot numbers wrap round. Only magazines are searched (l.4672).
  std::optional<PotFound> find(const ToolTables& tables, const PotSearch& search);

private:
  void markTools(const ToolTables& tables, const CartridgeShape& shape, uint32_t moving);

  std::vector<uint8_t> taken_; // cells
};

} // namespace rung::sim::nct
