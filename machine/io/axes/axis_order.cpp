// Instructions of axes (see axis_order.h).
#include "machine/io/axes/axis_order.h"

#include "machine/io/analog/analog_outputs.h"
#include "machine/io/axes/positioning_unit.h"
#include "machine/io/device_call.h"

namespace rung::io {
namespace {

constexpr std::string_view kOrders[] = {"",        "ANALOG_PORT", "ANALOG",    "ANALOG_SPI", "AX_SPI",     "SPI_MAIN",
                                        "SPI_AX",  "REGUL_X",     "REGUL_Y",   "REGUL_Z",    "REGUL_4",    "REGUL_5",
                                        "REGUL_6", "POS_INIT",    "POS_RESET", "POS_MODE",   "POS_CONTROL"};

using enum AxisOrder;

// Operands that a cell may put out of range, of the orders `first` to `last`.
struct Limit {
  AxisOrder first, last;
  uint8_t arguments; // that the request has; 0: whatever it has
  uint8_t argument;
  std::string_view operand;
  int64_t least, most;
};
constexpr auto kMostRole = static_cast<int64_t>(SpindleRole::Assistant);
constexpr Limit kLimits[] = {
    {AnalogPort, AnalogPort, 0, 0, "port", 1, kAnalogPorts},
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

} // namespace

AxisOrder axisOrder(std::string_view service) { return orderOf<AxisOrder>(kOrders, service); }

std::optional<WrongOperand> outOfRange(DeviceOrder device, const core::ServiceRequest& request) {
  if (device.device != DeviceKind::Axes) return std::nullopt;
  const auto order = static_cast<AxisOrder>(device.order);
  for (const Limit& limit : kLimits) {
    if (order < limit.first || order > limit.last) continue;
    if (limit.arguments != 0 && limit.arguments != request.argCount) continue;
    const int64_t value = request.args[limit.argument];
    if (value == nc::technol::kNotGiven || (value >= limit.least && value <= limit.most)) continue;
    return WrongOperand{limit.operand, value};
  }
  return std::nullopt;
}

void answerNothing(AxisOrder order, DeviceCall& call) {
  if (order != PositionMode && order != PositionControl) return;
  call.set(0, nc::technol::kNotGiven);
  call.set(1, nc::technol::kNotGiven);
}

std::string_view nameOf(AxisOrder order) { return kOrders[static_cast<size_t>(order)]; }

} // namespace rung::io
