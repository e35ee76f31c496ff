// The travel of one axis to its reference point, by its RefMethod (man. l.11612-11662, l.11792-11941).
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "sim/technol/devices/axis.h"

namespace rung::sim::technol {

// Whether the method moves the axis to a switch or a mark, with REFPI on (l.6757, l.11798-11887). The other methods set
// the zero point without motion.
bool isActualTravel(uint32_t method);

class ReferenceTravel {
public:
  bool active() const { return phase_ != Phase::None; }
  // Not for RefMethod 1, which the program executes.
  void begin(Axis& axis);
  // Ends the travel; the axis brakes.
  void end(Axis& axis, double acceleration);
  // One millisecond: `drive` before the axis moves, `look` after it; `look` returns whether the travel is done.
  void drive(Axis& axis, uint32_t index, const AxisInputs& in);
  bool look(Axis& axis);

  template <class Archive>
  void state(Archive& archive) {
    archive(phase_, fresh_, negative_, reversed_, low_, armed_, switchWas_, from_);
  }

private:
  enum class Phase : uint8_t {
    None,
    Seek,    // towards the switch and the zero pulse
    Leave,   // reversed: until the switch falls
    Overrun, // the zero point is known, the axis brakes
    Further, // MoveToPosAfterRef
  };
  void observe(Axis& axis, uint32_t index, const AxisInputs& in);
  void observeZeroPulse(const AxisAttributes& own, uint32_t index, const AxisInputs& in);
  void observeSwitch(Axis& axis, bool on);
  void zeroHere(Axis& axis, double value);
  void move(Axis& axis, const AxisInputs& in) const;
  double target(const Axis& axis) const;

  Phase phase_ = Phase::None;
  bool fresh_ = false; // the edge of a switch requires a previous reading
  bool negative_ = false, reversed_ = false;
  bool low_ = false;   // RefSpeedLow is used from now on
  bool armed_ = false; // zero pulses are evaluated
  bool switchWas_ = false;
  double from_ = 0; // start of a coded distance
};

// Reference (man. chapter 15): the operator's commands, HOMING_REQ and HOMING_START_REQ of the program, and the
// travels.

// The operator's commands (l.11767-12030).
enum class ReferenceKind : uint8_t { Single, Plc, Group, Pseudo, Simulated, Clear };

class Reference {
public:
  void reset() { *this = Reference(); }
  // Executed in the next tick.
  void order(ReferenceKind kind, AxisMask axes) { setBits(ordered_[static_cast<uint32_t>(kind)], axes); }
  // Another mover takes the axis: it brakes.
  void drop(Axis& axis, uint32_t index);
  // One millisecond: `drive` before the axes move, `look` after it.
  void drive(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, Stop stop, Complaints& complaints);
  void look(std::span<Axis> axes, AxisRequests& requests);
  // REFPI: whether an axis is moving to its reference, for any reason.
  bool underWay(std::span<const Axis> axes) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(travels_, ordered_);
  }

private:
  static void setBits(AxisMask& mask, AxisMask bits) { mask = static_cast<AxisMask>(mask | bits); }
  AxisMask take(ReferenceKind kind);
  void takeSingles(std::span<Axis> axes, AxisRequests& requests, Complaints& complaints);
  void takeOrders(std::span<Axis> axes, AxisRequests& requests, Complaints& complaints);
  void takeRequests(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, Complaints& complaints);
  bool begin(Axis& axis, uint32_t index, AxisRequests& requests, Complaints& complaints);
  void stopAll(std::span<Axis> axes, AxisRequests& requests, Stop stop);

  std::array<ReferenceTravel, kMaxAxes> travels_ = {};
  std::array<AxisMask, 6> ordered_ = {}; // indexed by ReferenceKind
};

} // namespace rung::sim::technol
