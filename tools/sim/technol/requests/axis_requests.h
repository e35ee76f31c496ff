// Instructions of spindles, servos and positioning units, answered by the axes of the simulated control (man. ch. 12,
// 13.1, 19).
#pragma once
#include "tools/device-requests/axis_order.h"
#include "tools/device-requests/device_call.h"
#include "tools/sim/technol/devices/axes.h"
#include "tools/sim/technol/requests/axis_places.h"

namespace rung::sim::technol {

void answerAxis(Axes& axes, const AxisPlaces& places, device_requests::AxisOrder order,
                device_requests::DeviceCall& call);

} // namespace rung::sim::technol
