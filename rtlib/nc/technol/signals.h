// Signals of the dialect technol. The manual prints no addresses; every area is packed in table order, with the bits of
// one group and direction eight to a byte; a bit whose container is printed is inside it (column layout).
//   "I"            cells that a program names; names of other areas are not names of a program
//   "W"            weights: byteOffset and bit count from the cell they are applied to (CELL.WEIGHT)
//   "BLK"          one element of the block queue, BLK[n]
//   STRUCTURE      members of TIME_INFOS, INOUTS, TLxWS, ...; symbol is "STRUCTURE.MEMBER"
//   "RTM.Axis" ... modules of logical inputs and outputs
//   "SHARE", "SHARE.STRUCTURE", "RtmVar"  variables shared with the panel by name
#pragma once

#include <span>

#include "rtlib/nc/signals.h"

namespace rung::nc {

const SignalTable& technolSignals();
std::span<const SignalNote> technolSignalNotes(); // in the order of the rows

} // namespace rung::nc
