// Instructions of spindles, servos and positioning units, answered by the axes of the simulated control (man. ch. 12,
// 13.1, 19).
#pragma once
#include <optional>
#include <string_view>

#include "tools/device-requests/device_call.h"
#include "tools/sim/technol/devices/axes.h"
#include "tools/sim/technol/requests/axis_places.h"

namespace rung::sim::technol {

// What a request asks for; None: no such service.
enum class AxisOrder : uint8_t {
  None,
  AnalogPort,
  Analog,
  AnalogSpindle,
  ToSpindle,
  MainSpindle,
  ToAxis,
  RegulatorX, // and those of the five next axes
  RegulatorY,
  RegulatorZ,
  Regulator4,
  Regulator5,
  Regulator6,
  PositionInit,
  PositionReset,
  PositionMode,
  PositionControl,
};
AxisOrder axisOrder(std::string_view service);
// The first operand that is outside what the instruction takes: it then does nothing, in a scripted control, too.
std::optional<Complaint> outOfRange(AxisOrder order, const rt::ServiceRequest& request);
// Answers one that does nothing: records stay as they are.
void answerNothing(AxisOrder order, device_requests::DeviceCall& call);
void answerAxis(Axes& axes, const AxisPlaces& places, AxisOrder order, device_requests::DeviceCall& call);

} // namespace rung::sim::technol
