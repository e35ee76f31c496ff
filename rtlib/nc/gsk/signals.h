// Signals of the dialect gsk.
// Areas "X", "Y", "F", "G": the bytes of the machine and CNC interface, addressed as printed (man. l.564-583).
#pragma once

#include <span>

#include "rtlib/nc/signals.h"

namespace rung::nc {

const SignalTable& gskSignals();
std::span<const SignalNote> gskSignalNotes(); // in the order of the rows

} // namespace rung::nc
