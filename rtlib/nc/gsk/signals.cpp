// The generated table of gsk.
#include "rtlib/nc/gsk/signals.h"

#include <array>

namespace rung::nc {

namespace {
#include "gsk_signals.inc"
constexpr SignalTable kTable{kSignals, kByName, kIgnoreCase};
} // namespace

const SignalTable& gskSignals() { return kTable; }
std::span<const SignalNote> gskSignalNotes() { return kNotes; }

} // namespace rung::nc
