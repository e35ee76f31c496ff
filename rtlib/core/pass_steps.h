// The steps of a scan in fewer steps that do the same: a program's list has one for each slice of time, and most of
// them have nothing to do.
#pragma once
#include <cstdint>
#include <span>

#include "rung/program.h"

namespace rung::core {

// A hook that the control has nothing to do for; `works`: those that it has something to do for, a bit each.
inline bool isIdle(const rung_step& step, uint32_t works) noexcept {
  return step.op == RUNG_STEP_HOOK && step.arg < 32 && (works >> step.arg & 1) == 0;
}

// Writes to `joined` the steps of `list` without idle hooks; times that scan, and runs of one task, with nothing in
// between are one step. Their number: `joined` has room for as many as `list` has.
uint32_t joinSteps(std::span<const rung_step> list, uint32_t works, rung_step* joined) noexcept;

} // namespace rung::core
