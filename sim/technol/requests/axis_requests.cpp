// Requests to the axes (see axis_requests.h).
#include "sim/technol/requests/axis_requests.h"

#include <optional>

#include "machine/io/analog/analog_requests.h"
#include "machine/io/axes/position_requests.h"

namespace rung::sim::technol {

using io::AxisOrder, io::DeviceCall;

namespace {

// The axes' side of analogue outputs and of positioning units.
class Target final : public io::AnalogTarget, public io::PositionTarget {
public:
  explicit Target(Axes& axes) : axes_(axes) {}
  void analogPort(int64_t port) override { axes_.analogPort(port); }
  AnalogOutput analog(int64_t value) override { return axes_.analog(value); }
  AnalogOutput analogOnSpindle(int64_t value, int64_t axis, int64_t spi) override {
    return axes_.analogOnSpindle(value, axis, spi);
  }
  AnalogOutput analogSpi(int64_t value, int64_t axis) override { return axes_.analogSpi(value, axis); }
  AnalogOutput axSpi(int64_t axis, SpindleRole role) override { return axes_.axSpi(axis, role); }
  void spiMain(int64_t axis) override { axes_.spiMain(axis); }
  void posInit(int64_t axis, int64_t space, bool loopClosed) override { axes_.posInit(axis, space, loopClosed); }
  PositioningUnits::Mode posMode(int64_t axis, int32_t length, uint16_t acceleration) override {
    return axes_.posMode(axis, length, acceleration);
  }
  PositioningUnits::State posControl(int64_t axis, uint32_t feed, bool mp) override {
    return axes_.posControl(axis, feed, mp);
  }
  void posReset(int64_t axis) override { axes_.posReset(axis); }

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

} // namespace

void answerAxis(Axes& axes, const AxisPlaces& places, AxisOrder order, DeviceCall& call) {
  Target target(axes);
  if (io::answerAnalog(target, order, call)) return;
  if (io::answerPosition(target, places.cells(), order, call)) return;
  switch (order) {
  case AxisOrder::None: return;
  case AxisOrder::ToAxis: return toAxis(axes, call);
  default:
    return axes.regul(static_cast<int64_t>(order) - static_cast<int64_t>(AxisOrder::RegulatorX) + 1, call.arg(0));
  }
}

} // namespace rung::sim::technol
