// Signals of the dialect nct.
// One area "M": the NC communication words 0002 and up (man. l.281-307). The manual prints no addresses (l.6448); the
// rows are allocated in table order, inputs first, words before the bits that have no named word. byteOffset = 4 *
// word; element i of a signal with multiplicity is i * strideBytes further.
#pragma once

#include <span>

#include "rtlib/nc/signals.h"

namespace rung::nc {

const SignalTable& nctSignals();
std::span<const SignalNote> nctSignalNotes(); // in the order of the rows

} // namespace rung::nc
