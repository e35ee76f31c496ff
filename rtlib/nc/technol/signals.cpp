// The generated table of technol.
#include "rtlib/nc/technol/signals.h"

#include <array>

namespace rung::nc {

namespace {
#include "technol_signals.inc"
constexpr SignalTable kTable{kSignals, kByName, kIgnoreCase};
} // namespace

const SignalTable& technolSignals() { return kTable; }
std::span<const SignalNote> technolSignalNotes() { return kNotes; }

} // namespace rung::nc
