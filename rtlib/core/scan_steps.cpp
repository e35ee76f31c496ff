// See scan_steps.h.
#include "rtlib/core/scan_steps.h"

namespace rung::core {
namespace {

bool isOneWith(const rung_step& step, const rung_step& next) noexcept {
  const bool adds = step.op == RUNG_STEP_ADVANCE || step.op == RUNG_STEP_RUN;
  return adds && step.op == next.op && step.task == next.task && next.arg <= UINT32_MAX - step.arg;
}

} // namespace

uint32_t joinSteps(std::span<const rung_step> list, uint32_t works, rung_step* joined) noexcept {
  uint32_t count = 0;
  for (const rung_step& step : list) {
    if (isIdle(step, works)) continue;
    if (count != 0 && isOneWith(joined[count - 1], step))
      joined[count - 1].arg += step.arg;
    else
      joined[count++] = step;
  }
  return count;
}

} // namespace rung::core
