// Analogue outputs (see analog_outputs.h).
#include "machine/io/analog/analog_outputs.h"

#include <algorithm>

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

} // namespace rung::io
