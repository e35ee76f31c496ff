// The generated table of fanuc.
#include "rtlib/nc/fanuc/signals.h"

#include <array>

namespace rung::nc {

namespace {
#include "fanuc_signals.inc"
constexpr SignalTable kTable{kSignals, kByName, kIgnoreCase};
} // namespace

const SignalTable& fanucSignals() { return kTable; }
std::span<const SignalNote> fanucSignalNotes() { return kNotes; }

} // namespace rung::nc
