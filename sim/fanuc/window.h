// The answers of the simulated CNC to window requests, from its tables and axes.
#pragma once
#include "rtlib/core/queues.h"
#include "sim/pmc/window.h"

namespace rung::sim::fanuc {

void answerWindow(const core::ServiceRequest& request, const pmc::Window& window, core::ServiceReply& reply);

} // namespace rung::sim::fanuc
