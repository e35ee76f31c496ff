// The tool pattern table (man. 6.26.3, l.4498-4612): how much room the figures of oversize tools take around their pot,
// in half pots. Figure 0 and rows that were never written take one pot.
#pragma once
#include <array>
#include <cstdint>

#include "sim/nct/kept.h"

namespace rung::sim::nct {

struct ToolPattern {
  uint32_t left = 0; // towards lower pot numbers
  uint32_t right = 0;
  uint32_t up = 0; // towards lower rows; matrix-type cartridges only
  uint32_t down = 0;
  bool round = false; // geometry B: the corners stay empty
};

class PatternTable {
public:
  static constexpr uint32_t kRows = 20; // l.4543

  static bool has(uint32_t figure) { return figure >= 1 && figure <= kRows; }
  const ToolPattern& row(uint32_t figure) const { return rows_[figure <= kRows ? figure : 0]; }
  void set(uint32_t figure, const ToolPattern& pattern) {
    if (has(figure)) rows_[figure] = pattern;
  }
  void clear() { rows_.fill({}); }
  void keep(Kept& kept) { kept.value(rows_); }

private:
  std::array<ToolPattern, kRows + 1> rows_{};
};

} // namespace rung::sim::nct
