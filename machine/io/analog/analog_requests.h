// ANALOG_PORT, ANALOG, ANALOG_SPI, AX_SPI and SPI_MAIN: analogue outputs and spindles (man. ch. 12).
#pragma once
#include "machine/io/analog/analog_outputs.h"
#include "machine/io/axes/axis_order.h"
#include "machine/io/device_call.h"

namespace rung::io {

// The owner of the outputs. Operands that outOfRange has let through; an axis may still not exist.
class AnalogTarget {
public:
  virtual void analogPort(int64_t port) = 0;
  virtual AnalogOutput analog(int64_t value) = 0; // on the active port
  virtual AnalogOutput analogOnSpindle(int64_t value, int64_t axis, int64_t spi) = 0;
  virtual AnalogOutput analogSpi(int64_t value, int64_t axis) = 0;
  virtual AnalogOutput axSpi(int64_t axis, SpindleRole role) = 0;
  virtual void spiMain(int64_t axis) = 0;

protected:
  ~AnalogTarget() = default;
};

// False: another order.
bool answerAnalog(AnalogTarget& target, AxisOrder order, DeviceCall& call);

} // namespace rung::io
