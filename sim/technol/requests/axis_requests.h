// Instructions of spindles, servos and positioning units, answered by the axes of the simulated control (man. ch. 12,
// 13.1, 19).
#pragma once
#include "machine/io/axes/axis_order.h"
#include "machine/io/device_call.h"
#include "sim/technol/devices/axes.h"
#include "sim/technol/requests/axis_places.h"

namespace rung::sim::technol {

void answerAxis(Axes& axes, const AxisPlaces& places, io::AxisOrder order, io::DeviceCall& call);

} // namespace rung::sim::technol
