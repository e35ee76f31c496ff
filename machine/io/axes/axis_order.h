// Instructions of spindles, servos and positioning units (man. ch. 12, 13.1, 19).
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "machine/io/device_order.h"
#include "rtlib/core/queues.h"

namespace rung::io {

class DeviceCall;

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

struct WrongOperand {
  std::string_view operand;
  int64_t value = 0;
};
// The first operand of an order to axes that is outside what the instruction takes, as a cell may have it: it then does
// nothing. Nothing: none is, or it is an order to another device.
std::optional<WrongOperand> outOfRange(DeviceOrder order, const core::ServiceRequest& request);
// Answers one that does nothing: records stay as they are.
void answerNothing(AxisOrder order, DeviceCall& call);

// The mnemonic; "" of None.
std::string_view nameOf(AxisOrder order);

} // namespace rung::io
