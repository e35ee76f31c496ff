// Requests to the axes (see axis_requests.h).
#include "tools/sim/technol/requests/axis_requests.h"

#include <optional>

#include "tools/device-requests/analog_requests.h"

namespace rung::sim::technol {

using device_requests::AxisOrder, device_requests::DeviceCall;

namespace {

// The axes' side of analogue outputs.
class Outputs final : public device_requests::AnalogTarget {
public:
  explicit Outputs(Axes& axes) : axes_(axes) {}
  void analogPort(int64_t port) override { axes_.analogPort(port); }
  AnalogOutput analog(int64_t value) override { return axes_.analog(value); }
  AnalogOutput analogOnSpindle(int64_t value, int64_t axis, int64_t spi) override {
    return axes_.analogOnSpindle(value, axis, spi);
  }
  AnalogOutput analogSpi(int64_t value, int64_t axis) override { return axes_.analogSpi(value, axis); }
  AnalogOutput axSpi(int64_t axis, SpindleRole role) override { return axes_.axSpi(axis, role); }
  void spiMain(int64_t axis) override { axes_.spiMain(axis); }

private:
  Axes& axes_;
};

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
    const bool closed = known && places.isLoopClosed(call.memory(), static_cast<uint32_t>(axis));
    return axes.posInit(axis, call.argOr(1, 0), closed);
  }
  case AxisOrder::PositionReset: return axes.posReset(call.arg(0));
  case AxisOrder::PositionMode: return mode(axes, call);
  default: return control(axes, call);
  }
}

} // namespace

void answerAxis(Axes& axes, const AxisPlaces& places, AxisOrder order, DeviceCall& call) {
  Outputs outputs(axes);
  if (device_requests::answerAnalog(outputs, order, call)) return;
  switch (order) {
  case AxisOrder::None: return;
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
