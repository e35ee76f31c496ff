// An axis as those who move it have it: its configuration, the motion that it is to make, and who has it.
#pragma once
#include <cstdint>

#include "tools/devices/axes/axis_attributes.h"
#include "tools/devices/axes/motion.h"

namespace rung::devices {

enum class Mover : uint8_t { None, SpindlePositioning, PositioningUnit, Reference, Manual };

struct DrivenAxis {
  AxisAttributes attributes;
  Motion motion;
  Mover mover = Mover::None;
  bool requested = false; // PO_OSxPI: a motion is wanted, also where it is not allowed (l.6243-6250)
  bool negative = false;  // SM_POxPI: direction of that motion
  bool settled = true;    // what moves is where `motion` has it, within what the configuration allows

  void request(bool inNegative) {
    requested = true;
    negative = inNegative;
  }
  // Its mover leaves it: it brakes to a standstill, until which its motion is reported.
  void leave(double acceleration) {
    mover = Mover::None;
    motion.stop(acceleration);
  }
};

} // namespace rung::devices
