// Requests to analogue outputs (see analog_requests.h). Results are the port that has changed and its value.
#include "machine/io/analog/analog_requests.h"

namespace rung::io {

namespace {

void setOutput(DeviceCall& call, const AnalogOutput& output) {
  call.set(0, output.port);
  call.setReal(1, output.value);
}

// ANALOG val port, or ANALOG val axis spi.
AnalogOutput analog(AnalogTarget& target, const DeviceCall& call) {
  if (call.argCount() == 3) return target.analogOnSpindle(call.arg(0), call.arg(1), call.argOr(2, 0));
  target.analogPort(call.arg(1));
  return target.analog(call.arg(0));
}

// Of AX_SPI: 0, 1, 2, or kFirstSpindleWord for S; not given, it is the main spindle (inventory of the services, 4).
SpindleRole roleOf(int64_t operand) {
  if (operand == nc::technol::kNotGiven) return SpindleRole::Main;
  return operand == nc::technol::kFirstSpindleWord ? SpindleRole::Keep : static_cast<SpindleRole>(operand);
}

} // namespace

bool answerAnalog(AnalogTarget& target, AxisOrder order, DeviceCall& call) {
  switch (order) {
  case AxisOrder::AnalogPort: target.analogPort(call.arg(0)); return true;
  case AxisOrder::Analog: setOutput(call, analog(target, call)); return true;
  case AxisOrder::AnalogSpindle: setOutput(call, target.analogSpi(call.arg(0), call.arg(1))); return true;
  case AxisOrder::ToSpindle: setOutput(call, target.axSpi(call.arg(0), roleOf(call.arg(1)))); return true;
  case AxisOrder::MainSpindle: target.spiMain(call.arg(0)); return true;
  default: return false;
  }
}

} // namespace rung::io
