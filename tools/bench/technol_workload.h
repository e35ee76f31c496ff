// TECHNOL programs and the C++ that somebody would write by hand for them. A mechanism has two states: it sets an
// output and waits for a contact, resets it and waits for the contact to fall.
#pragma once
#include "tools/bench/workload.h"

namespace rung::bench {

// Nothing but mechanisms; all idle, or all waiting in their first state.
Workload mechanismsWorkload(uint32_t mechanisms, bool waiting);

// About that many lines: equations, arithmetic and comparisons of words, one line of ten part of a mechanism.
Workload technolWorkload(uint32_t lines, uint64_t seed);

} // namespace rung::bench
