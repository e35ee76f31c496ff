// Requests to positioning units (see position_requests.h).
#include "machine/io/axes/position_requests.h"

namespace rung::io {

namespace {

void init(PositionTarget& target, const AxisCells& cells, const DeviceCall& call) {
  const int64_t axis = call.arg(0);
  const bool known = axis >= 1 && axis <= kMaxAxes;
  target.posInit(axis, call.argOr(1, 0), known && cells.loops().read(call.memory(), static_cast<uint32_t>(axis)));
}

void mode(PositionTarget& target, DeviceCall& call) {
  const PositioningUnits::Mode mode =
      target.posMode(call.arg(2), static_cast<int32_t>(call.arg(0)), static_cast<uint16_t>(call.arg(1)));
  call.set(0, mode.accepted ? mode.control : nc::technol::kNotGiven);
}

void control(PositionTarget& target, DeviceCall& call) {
  const PositioningUnits::State state =
      target.posControl(call.arg(2), static_cast<uint32_t>(call.arg(0)), call.arg(1) != 0);
  call.set(0, state.status);
  call.set(1, state.programmed ? state.control : nc::technol::kNotGiven);
}

} // namespace

std::optional<int64_t> positionedAxis(AxisOrder order, const core::ServiceRequest& request) {
  switch (order) {
  case AxisOrder::PositionInit:
  case AxisOrder::PositionReset: return request.args[0];
  case AxisOrder::PositionMode:
  case AxisOrder::PositionControl: return request.args[2];
  default: return std::nullopt;
  }
}

bool answerPosition(PositionTarget& target, const AxisCells& cells, AxisOrder order, DeviceCall& call) {
  switch (order) {
  case AxisOrder::PositionInit: init(target, cells, call); return true;
  case AxisOrder::PositionReset: target.posReset(call.arg(0)); return true;
  case AxisOrder::PositionMode: mode(target, call); return true;
  case AxisOrder::PositionControl: control(target, call); return true;
  default: return false;
  }
}

} // namespace rung::io
