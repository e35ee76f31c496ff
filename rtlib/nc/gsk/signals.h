// Signals of the dialect gsk.
// Areas "X", "Y", "F", "G": the bytes of the machine and CNC interface, addressed as printed (man. l.564-583).
#pragma once

#include "rtlib/nc/signal.h"

namespace rung::nc {

const SignalTable& gskSignals();

} // namespace rung::nc
