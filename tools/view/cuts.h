// Where a rung that is too wide is cut. Internal to the layout.
#pragma once
#include <vector>

#include "tools/view/sheet.h"

namespace rung::view {

inline constexpr int kBandStart = 64; // x of the first cell of a band after a cut
inline constexpr int kBandWire = 52;  // and of the wires that continue there
inline constexpr int kBandEnd = 40;   // from the ends of the wires to the right rail

// Places, from left to right, that no cell but a joint lies across: a band is what begins between two of them.
using Cuts = std::vector<int>;

// `left`, `width`: of the cells. `needed`: where the right rail of the whole would be, `rail`: where it is to be.
// A band may be wider where there is no place for a cut.
Cuts chooseCuts(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& width, int needed, int rail);

} // namespace rung::view
