// POS_INIT, POS_MODE, POS_CONTROL and POS_RESET: positioning units (man. ch. 19).
#pragma once
#include "machine/io/axes/axis_cells.h"
#include "machine/io/axes/axis_order.h"
#include "machine/io/axes/positioning_unit.h"
#include "machine/io/device_call.h"

namespace rung::io {

// The owner of the units.
class PositionTarget {
public:
  // `loopClosed`: VAZBA_x of now.
  virtual void posInit(int64_t axis, int64_t space, bool loopClosed) = 0;
  virtual PositioningUnits::Mode posMode(int64_t axis, int32_t length, uint16_t acceleration) = 0;
  virtual PositioningUnits::State posControl(int64_t axis, uint32_t feed, bool mp) = 0;
  virtual void posReset(int64_t axis) = 0;

protected:
  ~PositionTarget() = default;
};

// The axis of such an order, as it is given; nothing: another order.
std::optional<int64_t> positionedAxis(AxisOrder order, const core::ServiceRequest& request);
// False: another order.
bool answerPosition(PositionTarget& target, const AxisCells& cells, AxisOrder order, DeviceCall& call);

} // namespace rung::io
