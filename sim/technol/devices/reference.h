// Reference (man. chapter 15): the operator's orders, HOMING_REQ and HOMING_START_REQ of the program, and the travels.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "sim/technol/devices/reference_travel.h"

namespace rung::sim::technol {

// The operator's orders (l.11767-12030).
enum class ReferenceKind : uint8_t { Single, Plc, Group, Pseudo, Simulated, Clear };

class Reference {
public:
  void reset() { *this = Reference(); }
  // Carried out in the next tick.
  void order(ReferenceKind kind, AxisMask axes) { setBits(ordered_[static_cast<uint32_t>(kind)], axes); }
  // The axis is taken from it: it brakes.
  void drop(Axis& axis, uint32_t index);
  // A millisecond: before the axes move, and after.
  void drive(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, Stop stop, Complaints& complaints);
  void look(std::span<Axis> axes, AxisRequests& requests);
  // REFPI: an axis is on its way to a reference, for any caller.
  bool underWay(std::span<const Axis> axes) const;

private:
  static void setBits(AxisMask& mask, AxisMask bits) { mask = static_cast<AxisMask>(mask | bits); }
  AxisMask take(ReferenceKind kind);
  void takeSingles(std::span<Axis> axes, AxisRequests& requests, Complaints& complaints);
  void takeOrders(std::span<Axis> axes, AxisRequests& requests, Complaints& complaints);
  void takeRequests(std::span<Axis> axes, const AxisInputs& in, AxisRequests& requests, Complaints& complaints);
  bool begin(Axis& axis, uint32_t index, AxisRequests& requests, Complaints& complaints);
  void stopAll(std::span<Axis> axes, AxisRequests& requests, Stop stop);

  std::array<ReferenceTravel, kMaxAxes> travels_ = {};
  std::array<AxisMask, 6> ordered_ = {}; // by ReferenceKind
};

} // namespace rung::sim::technol
