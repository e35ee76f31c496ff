// Signals of the dialect fanuc.
// Areas "X", "F", "G": the bytes of the machine and CNC interface of path 1. `group` is how certain a row is: high, in
// two sources or real programs; medium, in one source.
#pragma once

#include <span>

#include "rtlib/nc/signals.h"

namespace rung::nc {

const SignalTable& fanucSignals();
std::span<const SignalNote> fanucSignalNotes(); // in the order of the rows

} // namespace rung::nc
