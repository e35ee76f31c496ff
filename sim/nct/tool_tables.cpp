// The tables of the tool management (see tool_tables.h).
#include "sim/nct/tool_tables.h"

namespace rung::sim::nct {

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

} // namespace rung::sim::nct
