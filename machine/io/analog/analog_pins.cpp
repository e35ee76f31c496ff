// Pins of analogue outputs (see analog_pins.h).
#include "machine/io/analog/analog_pins.h"

#include <algorithm>
#include <string>

#include "machine/io/analog/analog_outputs.h"
#include "machine/io/axes/axis_order.h"
#include "machine/io/device_order.h"

namespace rung::io {
namespace {

bool hasAnalogOutputs(const rung_program& program) {
  return std::ranges::any_of(deviceOrders(program), [](const DeviceOrder& order) {
    const auto axis = static_cast<AxisOrder>(order.order);
    return order.device == DeviceKind::Axes && axis >= AxisOrder::AnalogPort && axis <= AxisOrder::MainSpindle;
  });
}

} // namespace

void addAnalogPins(host::File& map, const rung_program& program) {
  constexpr uint32_t kRealBytes = 8;
  if (map.paths.empty() || !hasAnalogOutputs(program)) return;
  for (uint32_t port = 1; port <= kAnalogPorts; ++port) {
    const std::string name = "analog-out-" + std::to_string(port);
    if (std::ranges::find(map.pins, name, &host::Pin::name) != map.pins.end()) continue;
    const auto pin = static_cast<uint32_t>(map.pins.size());
    map.pins.push_back({.name = name, .type = host::PinType::Float, .direction = host::Direction::Out});
    map.links.push_back({.pin = pin, .name = "SU_OUT_PLC+" + std::to_string((port - 1) * kRealBytes)});
  }
}

} // namespace rung::io
