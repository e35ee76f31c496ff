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
// The first operand of an axis request that is out of the instruction's range, which is possible if it comes from a
// cell; the instruction then does nothing. Nothing: all operands are in range, or the request is for another device.
std::optional<WrongOperand> outOfRange(const core::ServiceRequest& request);
// Answers a request that does nothing: its records stay unchanged.
void answerNothing(DeviceCall& call);

// Cells of axes that are the same for simulated and real axes (inventory of the services, 1.6, 15.1): permits, the
// position loop, requested motions, and positions.

// The name of an axis's bit: `#` in the pattern becomes X, Y, Z or the number from 4 on, `%` the number.
std::string nameOfAxis(std::string_view pattern, uint32_t axis);

// The places of one such bit for every axis.
class AxisBits {
public:
  AxisBits() = default; // for a program without these cells
  AxisBits(const rung_program& program, std::string_view pattern);
  AxisMask read(const core::Memory& memory) const;
  bool read(const core::Memory& memory, uint32_t axis) const { return memory.read(places_[axis - 1]) != 0; }
  // Writes the bits of the axes in `which`.
  void write(const core::Memory& memory, AxisMask which, AxisMask mask) const;

private:
  std::array<core::Place, kMaxAxes> places_;
};

class AxisCells {
public:
  AxisCells() = default; // for a program without these cells
  explicit AxisCells(const rung_program& program);

  void read(const core::Memory& memory, AxisPermits& permits) const;
  const AxisBits& loops() const { return loops_; }     // VAZBA_x: the position loop is closed (l.6306)
  const AxisBits& motions() const { return motions_; } // PO_OSxPI
  // Writes the cells of the axes in `which`.
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
  // `loopClosed`: current value of VAZBA_x.
  virtual void posInit(int64_t axis, int64_t space, bool loopClosed) = 0;
  virtual PositioningUnits::Mode posMode(int64_t axis, int32_t length, uint16_t acceleration) = 0;
  virtual PositioningUnits::State posControl(int64_t axis, uint32_t feed, bool mp) = 0;
  virtual void posReset(int64_t axis) = 0;

protected:
  ~PositionTarget() = default;
};

// The axis operand of such a request; nothing for other requests.
std::optional<int64_t> positionedAxis(const core::ServiceRequest& request);
// Returns false for other requests.
bool answerPosition(PositionTarget& target, const AxisCells& cells, DeviceCall& call);

} // namespace rung::io
