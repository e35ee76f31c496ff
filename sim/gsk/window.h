// The answers of the simulated CNC to window requests (man. §9.3, l.8482-8945), from its tables and axes.
#pragma once
#include "rtlib/core/queues.h"
#include "sim/pmc/window.h"

namespace rung::sim::gsk {

void answerWindow(const core::ServiceRequest& request, const pmc::Window& window, core::ServiceReply& reply);

} // namespace rung::sim::gsk
