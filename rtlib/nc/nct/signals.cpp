// The generated table of nct.
#include "rtlib/nc/nct/signals.h"

#include <array>

namespace rung::nc {

namespace {
#include "nct_signals.inc"
constexpr SignalTable kTable{kSignals, kByName, kIgnoreCase};
} // namespace

const SignalTable& nctSignals() { return kTable; }
std::span<const SignalNote> nctSignalNotes() { return kNotes; }

} // namespace rung::nc
