// Analogue outputs.
#include "machine/io/analog/analog.h"

#include <algorithm>
#include <string>

#include "machine/io/axes/axis_requests.h"
#include "machine/io/device_call.h"

namespace rung::io {

AnalogOutput AnalogOutputs::putOn(uint32_t port, int64_t value) {
  if (port == 0) return {};
  outputs_[port - 1] = static_cast<double>(std::clamp<int64_t>(value, -kFullOutput, kFullOutput));
  return {port, output(port)};
}

AnalogOutput AnalogOutputs::putOnSpindle(int64_t value, uint32_t axis, uint32_t spi) {
  if (spi == 1) return putOn(main_, value);
  if (spi == 2) return putOn(assistant_, value);
  return putOn(lastSwitched_ != 0 ? lastSwitched_ : axis, value);
}

AnalogOutput AnalogOutputs::switchTo(uint32_t axis, SpindleRole role) {
  lastSwitched_ = axis;
  off_ &= ~(1u << (axis - 1));
  if (role == SpindleRole::Keep) return {};
  if (main_ == axis) main_ = 0;
  if (assistant_ == axis) assistant_ = 0;
  if (role == SpindleRole::Main) main_ = axis;
  if (role == SpindleRole::Assistant) assistant_ = axis;
  if (role != SpindleRole::Off) return {};
  off_ |= 1u << (axis - 1);
  return putOn(axis, 0);
}

void AnalogOutputs::makeMain(uint32_t axis) {
  main_ = axis;
  if (assistant_ == axis) assistant_ = 0;
}

void AnalogOutputs::leave(uint32_t axis) {
  if (main_ == axis) main_ = 0;
  if (assistant_ == axis) assistant_ = 0;
  off_ &= ~(1u << (axis - 1));
}

// Pins of analogue outputs.

namespace {

bool hasAnalogOutputs(const rung_program& program) {
  return std::any_of(program.services, program.services + program.service_count, [&](const char* text) {
    const auto kind = static_cast<ServiceKind>(nc::serviceKind(program.dialect, text));
    return kind >= ServiceKind::AnalogPort && kind <= ServiceKind::MainSpindle;
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

// Requests to analogue outputs. Results are the changed port and its value.

namespace {

void setOutput(DeviceCall& call, const AnalogOutput& output) {
  call.set(0, output.port);
  call.setReal(1, output.value);
}

// The role in AX_SPI: 0, 1, 2, or kFirstSpindleWord for S; the main spindle if not given (inventory of the services,
// 4).
SpindleRole roleOf(int64_t operand) {
  if (operand == nc::technol::kNotGiven) return SpindleRole::Main;
  return operand == nc::technol::kFirstSpindleWord ? SpindleRole::Keep : static_cast<SpindleRole>(operand);
}

} // namespace

bool answerAnalog(AnalogTarget& target, DeviceCall& call) {
  switch (call.kind()) {
  case ServiceKind::AnalogPort: target.analogPort(call.arg(0)); return true;
  case ServiceKind::Analog:
    target.analogPort(call.arg(1));
    setOutput(call, target.analog(call.arg(0)));
    return true;
  case ServiceKind::AnalogOfAxis:
    setOutput(call, target.analogOnSpindle(call.arg(0), call.arg(1), call.argOr(2, 0)));
    return true;
  case ServiceKind::AnalogSpindle: setOutput(call, target.analogSpi(call.arg(0), call.arg(1))); return true;
  case ServiceKind::ToSpindle: setOutput(call, target.axSpi(call.arg(0), roleOf(call.arg(1)))); return true;
  case ServiceKind::MainSpindle: target.spiMain(call.arg(0)); return true;
  default: return false;
  }
}

} // namespace rung::io
