// Joins the steps of a scan: a program's list has a step for each slice of time, most of which do nothing.
#pragma once
#include <cstdint>
#include <span>

#include "rung/program.h"

namespace rung::core {

// Whether a step is a hook for which the control has no work; `works`: the hooks with work, a bit each.
inline bool isIdle(const rung_step& step, uint32_t works) noexcept {
  return step.op == RUNG_STEP_HOOK && step.arg < 32 && (works >> step.arg & 1) == 0;
}

// Writes the steps of `list` without idle hooks to `joined`; adjacent waiting times, and adjacent runs of one task,
// become one step. Returns their number; `joined` has room for as many steps as `list`.
uint32_t joinSteps(std::span<const rung_step> list, uint32_t works, rung_step* joined) noexcept;

} // namespace rung::core
