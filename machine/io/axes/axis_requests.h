// Instructions of spindles, servos and positioning units (man. ch. 12, 13.1, 19).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "machine/io/axes/axis_attributes.h"
#include "machine/io/axes/motion.h"
#include "machine/io/device_call.h"
#include "rtlib/core/memory.h"
#include "rtlib/core/queues.h"

namespace rung::io {

class DeviceCall;

struct WrongOperand {
  std::string_view operand;
  int64_t value = 0;
};
// The first operand of a request to axes that is outside what the instruction takes, as a cell may have it: it then
// does nothing. Nothing: none is, or it is a request to another device.
std::optional<WrongOperand> outOfRange(const core::ServiceRequest& request);
// Answers one that does nothing: records stay as they are.
void answerNothing(DeviceCall& call);

// Cells of axes that simulated and real ones have alike (inventory of the services, 1.6, 15.1): what lets them move,
// the position loop, requests for motions and places.

// The names that a bit of each axis has: `#` in the pattern is X, Y, Z and the numbers from 4 on, `%` the number.
std::string nameOfAxis(std::string_view pattern, uint32_t axis);

// The places of such bits.
class AxisBits {
public:
  AxisBits() = default; // a program that has nothing
  AxisBits(const rung_program& program, std::string_view pattern);
  AxisMask read(const core::Memory& memory) const;
  bool read(const core::Memory& memory, uint32_t axis) const { return memory.read(places_[axis - 1]) != 0; }
  // Those of the axes in `which`.
  void write(const core::Memory& memory, AxisMask which, AxisMask mask) const;

private:
  std::array<core::Place, kMaxAxes> places_;
};

class AxisCells {
public:
  AxisCells() = default; // a program that has nothing
  explicit AxisCells(const rung_program& program);

  void read(const core::Memory& memory, AxisPermits& permits) const;
  const AxisBits& loops() const { return loops_; }     // VAZBA_x: the position loop is closed (l.6306)
  const AxisBits& motions() const { return motions_; } // PO_OSxPI
  // Of the axes in `which`.
  void write(const core::Memory& memory, AxisMask which, const AxisReport& report) const;

private:
  AxisBits enabled_, limitPlus_, limitMinus_, loops_, motions_, directions_;
  std::array<core::Place, kMaxAxes> positionEx_, incrementEx_;
  std::array<core::Place, 6> positionShort_, incrementShort_;
  std::array<std::array<core::Place, kMaxAxes>, 5> positionOfSpaces_;
};

// POS_INIT, POS_MODE, POS_CONTROL and POS_RESET: positioning units (man. ch. 19).

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
std::optional<int64_t> positionedAxis(const core::ServiceRequest& request);
// False: another order.
bool answerPosition(PositionTarget& target, const AxisCells& cells, DeviceCall& call);

} // namespace rung::io
