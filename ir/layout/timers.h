// What a host may do in the place of chunks that are left out (rung_activity, rung_timer).
#pragma once
#include <vector>

#include "ir/chunks/cut.h"
#include "ir/layout/memory_layout.h"

namespace rung::ir {

// By rung of the main task's entry: each run of the task that no fault ends before it comes to the rung exactly once.
// Empty where the task has parts, or is not the only one to run the routine.
std::vector<bool> rungsRunOnce(const Module& module);

// Timers that run: by chunk, the cells that it moves on by one amount in each run and does nothing else with. A cell is
// among them where its rung and the head of its chunk are run once, nothing else in the module uses it, no copy of a
// task and no call of the host can see it within a run, and the rung does this alone:
//
//   down:  stores CELL - AMOUNT, compares CELL <= AMOUNT
//   up:    stores CELL + AMOUNT, compares LIMIT <= CELL + AMOUNT (or what an if gives in its place)
//
// and may ask whether the sum is negative. AMOUNT is a slot that other chunks write; LIMIT is a constant, or one times
// a 16-bit word that other chunks write.
std::vector<std::vector<rung_timer>> timersOf(const MemoryLayout& layout, const Cut& cut,
                                              const std::vector<bool>& once);

} // namespace rung::ir
