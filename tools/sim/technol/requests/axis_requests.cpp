// Requests to the axes (see axis_requests.h).
#include "tools/sim/technol/requests/axis_requests.h"

#include <iterator>

namespace rung::sim::technol {

using device_requests::DeviceCall;

namespace {

constexpr std::string_view kOrders[] = {"",        "ANALOG_PORT", "ANALOG",    "ANALOG_SPI", "AX_SPI",     "SPI_MAIN",
                                        "SPI_AX",  "REGUL_X",     "REGUL_Y",   "REGUL_Z",    "REGUL_4",    "REGUL_5",
                                        "REGUL_6", "POS_INIT",    "POS_RESET", "POS_MODE",   "POS_CONTROL"};

void setOutput(DeviceCall& call, const AnalogOutput& output) {
  call.set(0, output.port);
  call.setReal(1, output.value);
}

// ANALOG val port, or ANALOG val axis spi.
AnalogOutput analog(Axes& axes, const DeviceCall& call) {
  if (call.argCount() == 3) return axes.analogOnSpindle(call.arg(0), call.arg(1), call.argOr(2, 0));
  axes.analogPort(call.arg(1));
  return axes.analog(call.arg(0));
}

// Without a role it is the main spindle (inventory of the services, 4).
AnalogOutput toSpindle(Axes& axes, const DeviceCall& call) {
  return axes.axSpi(call.arg(0), static_cast<SpindleRole>(call.argOr(1, static_cast<int64_t>(SpindleRole::Main))));
}

void toAxis(Axes& axes, const DeviceCall& call) {
  const auto given = [&](uint32_t number) -> std::optional<int64_t> {
    return call.arg(number) == nc::technol::kNotGiven ? std::nullopt : std::optional(call.arg(number));
  };
  (void)axes.spiAx(call.arg(4), {.feed1 = given(0), .feed2 = given(1), .angle = given(2), .accel = given(3)});
}

void control(Axes& axes, DeviceCall& call) {
  const PositioningUnits::State state =
      axes.posControl(call.arg(2), static_cast<uint32_t>(call.arg(0)), call.arg(1) != 0);
  call.set(0, state.status);
  call.set(1, state.programmed ? state.control : nc::technol::kNotGiven);
}

void mode(Axes& axes, DeviceCall& call) {
  const PositioningUnits::Mode mode =
      axes.posMode(call.arg(2), static_cast<int32_t>(call.arg(0)), static_cast<uint16_t>(call.arg(1)));
  call.set(0, mode.accepted ? mode.control : nc::technol::kNotGiven);
}

void position(Axes& axes, const AxisPlaces& places, AxisOrder order, DeviceCall& call) {
  switch (order) {
  case AxisOrder::PositionInit: {
    const int64_t axis = call.arg(0);
    const bool known = axis >= 1 && axis <= kMaxAxes;
    const bool closed = known && places.isLoopClosed(call.instance().memory(), static_cast<uint32_t>(axis));
    return axes.posInit(axis, call.argOr(1, 0), closed);
  }
  case AxisOrder::PositionReset: return axes.posReset(call.arg(0));
  case AxisOrder::PositionMode: return mode(axes, call);
  default: return control(axes, call);
  }
}

} // namespace

AxisOrder axisOrder(std::string_view service) { return device_requests::orderOf<AxisOrder>(kOrders, service); }

void answerAxis(Axes& axes, const AxisPlaces& places, AxisOrder order, DeviceCall& call) {
  switch (order) {
  case AxisOrder::None: return;
  case AxisOrder::AnalogPort: return axes.analogPort(call.arg(0));
  case AxisOrder::Analog: return setOutput(call, analog(axes, call));
  case AxisOrder::AnalogSpindle: return setOutput(call, axes.analogSpi(call.arg(0), call.arg(1)));
  case AxisOrder::ToSpindle: return setOutput(call, toSpindle(axes, call));
  case AxisOrder::MainSpindle: return axes.spiMain(call.arg(0));
  case AxisOrder::ToAxis: return toAxis(axes, call);
  case AxisOrder::PositionInit:
  case AxisOrder::PositionReset:
  case AxisOrder::PositionMode:
  case AxisOrder::PositionControl: return position(axes, places, order, call);
  default:
    return axes.regul(static_cast<int64_t>(order) - static_cast<int64_t>(AxisOrder::RegulatorX) + 1, call.arg(0));
  }
}

} // namespace rung::sim::technol
