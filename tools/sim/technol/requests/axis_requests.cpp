// Requests to the axes (see axis_requests.h).
#include "tools/sim/technol/requests/axis_requests.h"

#include <iterator>

namespace rung::sim::technol {

using device_requests::DeviceCall;

namespace {

constexpr std::string_view kOrders[] = {"",        "ANALOG_PORT", "ANALOG",    "ANALOG_SPI", "AX_SPI",     "SPI_MAIN",
                                        "SPI_AX",  "REGUL_X",     "REGUL_Y",   "REGUL_Z",    "REGUL_4",    "REGUL_5",
                                        "REGUL_6", "POS_INIT",    "POS_RESET", "POS_MODE",   "POS_CONTROL"};

// Operands that a cell may put out of range, of the orders `first` to `last`.
struct Limit {
  AxisOrder first, last;
  uint8_t arguments; // that the request has; 0: whatever it has
  uint8_t argument;
  std::string_view operand;
  int64_t least, most;
};
using enum AxisOrder;
constexpr auto kMostRole = static_cast<int64_t>(SpindleRole::Assistant);
constexpr Limit kLimits[] = {
    {AnalogPort, AnalogPort, 0, 0, "port", 1, kPorts},
    {Analog, Analog, 3, 1, "axis", 1, kMaxAxes},
    {Analog, Analog, 3, 2, "spi", 0, kMostRole},
    {AnalogSpindle, AnalogSpindle, 0, 1, "axis", 1, kMaxAxes},
    {ToSpindle, MainSpindle, 0, 0, "axis", 1, kMaxAxes},
    {ToSpindle, ToSpindle, 0, 1, "spi", nc::technol::kFirstSpindleWord, kMostRole},
    {ToAxis, ToAxis, 0, 4, "axis", 1, kMaxAxes},
    {RegulatorX, Regulator6, 0, 0, "set", 1, kRegulatorSets},
    {PositionInit, PositionReset, 0, 0, "axis", 1, kMaxAxes},
    {PositionInit, PositionInit, 0, 1, "space", 0, kLastSpace},
    {PositionMode, PositionControl, 0, 2, "axis", 1, kMaxAxes},
};

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
  const auto role = axes.roleOf(call.argOr(1, static_cast<int64_t>(SpindleRole::Main)));
  return role ? axes.axSpi(call.arg(0), *role) : AnalogOutput{};
}

void toAxis(Axes& axes, DeviceCall& call) {
  const auto given = [&](uint32_t number) -> std::optional<int64_t> {
    return call.arg(number) == nc::technol::kNotGiven ? std::nullopt : std::optional(call.arg(number));
  };
  if (!axes.spiAx(call.arg(4), {.feed1 = given(0), .feed2 = given(1), .angle = given(2), .accel = given(3)}))
    call.refuse();
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

std::optional<Complaint> outOfRange(AxisOrder order, const rt::ServiceRequest& request) {
  for (const Limit& limit : kLimits) {
    if (order < limit.first || order > limit.last) continue;
    if (limit.arguments != 0 && limit.arguments != request.argCount) continue;
    const int64_t value = request.args[limit.argument];
    if (value == nc::technol::kNotGiven || (value >= limit.least && value <= limit.most)) continue;
    return Complaint{kOrders[static_cast<size_t>(order)], limit.operand, value, {}};
  }
  return std::nullopt;
}

void answerNothing(AxisOrder order, DeviceCall& call) {
  if (order != PositionMode && order != PositionControl) return;
  call.set(0, nc::technol::kNotGiven);
  call.set(1, nc::technol::kNotGiven);
}

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
