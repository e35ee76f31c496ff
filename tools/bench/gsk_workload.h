// A GSK program at the limit of the control, 12,000 steps (man. l.354), and the C++ that somebody would write by hand
// for it. Seven steps of ten are bit logic; the others timers, edges, arithmetic, comparisons, transfers and decoding.
// A tenth of it is Level 1, a fifth subprograms that Level 2 calls.
#pragma once
#include "tools/bench/workload.h"

namespace rung::bench {

Workload gskWorkload(uint32_t steps, uint64_t seed);

} // namespace rung::bench
