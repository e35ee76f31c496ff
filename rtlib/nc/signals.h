// The signals of a dialect's control, by the dialect's name.
#pragma once
#include "rtlib/nc/signal.h"

namespace rung::nc {

// By rung_program::dialect; null for one that does not exist.
const SignalTable* signalsOf(std::string_view dialect);

} // namespace rung::nc
