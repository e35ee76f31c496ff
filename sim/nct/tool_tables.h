// The three tables of the tool management (man. 6.26.1-6.26.3). They are one for all channels.
//
// Invariant: a data number in a pot is a row of the tool table.
#pragma once
#include <optional>

#include "sim/nct/cartridge_table.h"
#include "sim/nct/pattern_table.h"
#include "sim/nct/tool_table.h"

namespace rung::sim::nct {

// What the NC finds for a T code (l.4362-4372, 10742-10772).
struct ToolPick {
  bool expired = false;    // CN_TLLE: tools of the type are expired or broken, none is left (l.9733)
  uint32_t dataNumber = 0; // 0: none that can be searched is in a pot
  PotPlace place;          // of it, else 0, 0
};

struct ToolTables {
  ToolTable tools;
  CartridgeTable cartridges;
  PatternTable patterns;

  // Room in the cartridges; normal tools, figure 0 and no tool take one pot (l.4374-4380).
  const ToolPattern& patternOf(uint32_t dataNumber) const;

  // Of the tools with this type number in a pot that can be searched, the one with the greatest life counter, of equal
  // ones the lowest data number.
  ToolPick pick(int32_t type) const;
  // No tool with this type number can be searched, and one has expired or is broken.
  bool groupExpired(int32_t type) const;

  // The row becomes free and its pot empty.
  void remove(uint32_t dataNumber);
};

} // namespace rung::sim::nct
