// ANALOG_PORT, ANALOG, ANALOG_SPI, AX_SPI and SPI_MAIN: analogue outputs and spindles (man. ch. 12).
#pragma once
#include "tools/device-requests/axis_order.h"
#include "tools/device-requests/device_call.h"
#include "tools/devices/analog/analog_outputs.h"

namespace rung::device_requests {

// The owner of the outputs. Operands that outOfRange has let through; an axis may still not exist.
class AnalogTarget {
public:
  virtual void analogPort(int64_t port) = 0;
  virtual devices::AnalogOutput analog(int64_t value) = 0; // on the active port
  virtual devices::AnalogOutput analogOnSpindle(int64_t value, int64_t axis, int64_t spi) = 0;
  virtual devices::AnalogOutput analogSpi(int64_t value, int64_t axis) = 0;
  virtual devices::AnalogOutput axSpi(int64_t axis, devices::SpindleRole role) = 0;
  virtual void spiMain(int64_t axis) = 0;

protected:
  ~AnalogTarget() = default;
};

// False: another order.
bool answerAnalog(AnalogTarget& target, AxisOrder order, DeviceCall& call);

} // namespace rung::device_requests
