// POS_INIT, POS_MODE, POS_CONTROL and POS_RESET: positioning units (man. ch. 19).
#pragma once
#include "tools/device-requests/axis_cells.h"
#include "tools/device-requests/axis_order.h"
#include "tools/device-requests/device_call.h"
#include "tools/devices/axes/positioning_unit.h"

namespace rung::device_requests {

// The owner of the units.
class PositionTarget {
public:
  // `loopClosed`: VAZBA_x of now.
  virtual void posInit(int64_t axis, int64_t space, bool loopClosed) = 0;
  virtual devices::PositioningUnits::Mode posMode(int64_t axis, int32_t length, uint16_t acceleration) = 0;
  virtual devices::PositioningUnits::State posControl(int64_t axis, uint32_t feed, bool mp) = 0;
  virtual void posReset(int64_t axis) = 0;

protected:
  ~PositionTarget() = default;
};

// The axis of such an order, as it is given; nothing: another order.
std::optional<int64_t> positionedAxis(AxisOrder order, const rt::ServiceRequest& request);
// False: another order.
bool answerPosition(PositionTarget& target, const AxisCells& cells, AxisOrder order, DeviceCall& call);

} // namespace rung::device_requests
