// Pins of analogue outputs (see analog_pins.h).
#include "tools/host-devices/analog_pins.h"

#include <algorithm>
#include <string>

#include "tools/device-requests/axis_order.h"
#include "tools/device-requests/device_order.h"
#include "tools/devices/analog/analog_outputs.h"

namespace rung::host_devices {
namespace {

using device_requests::AxisOrder;

bool hasAnalogOutputs(const rung_program& program) {
  return std::ranges::any_of(device_requests::deviceOrders(program), [](const device_requests::DeviceOrder& order) {
    const auto axis = static_cast<AxisOrder>(order.order);
    return order.device == device_requests::DeviceKind::Axes && axis >= AxisOrder::AnalogPort &&
           axis <= AxisOrder::MainSpindle;
  });
}

} // namespace

void addAnalogPins(mapping::File& map, const rung_program& program) {
  constexpr uint32_t kRealBytes = 8;
  if (map.paths.empty() || !hasAnalogOutputs(program)) return;
  for (uint32_t port = 1; port <= devices::kAnalogPorts; ++port) {
    const std::string name = "analog-out-" + std::to_string(port);
    if (std::ranges::find(map.pins, name, &mapping::Pin::name) != map.pins.end()) continue;
    const auto pin = static_cast<uint32_t>(map.pins.size());
    map.pins.push_back({.name = name, .type = mapping::PinType::Float, .direction = mapping::Direction::Out});
    map.links.push_back({.pin = pin, .name = "SU_OUT_PLC+" + std::to_string((port - 1) * kRealBytes)});
  }
}

} // namespace rung::host_devices
