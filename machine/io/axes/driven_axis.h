// What all movers of an axis share: its configuration, its commanded motion, and which of them has it.
#pragma once
#include <cstdint>

#include "machine/io/axes/axis_attributes.h"
#include "machine/io/axes/motion.h"

namespace rung::io {

enum class Mover : uint8_t { None, SpindlePositioning, PositioningUnit, Reference, Manual };

struct DrivenAxis {
  AxisAttributes attributes;
  Motion motion;
  Mover mover = Mover::None;
  bool requested = false; // PO_OSxPI: a motion is requested, even where it is not permitted (l.6243-6250)
  bool negative = false;  // SM_POxPI: direction of that motion
  bool settled = true;    // the actual position follows `motion` within the configured tolerance

  void request(bool inNegative) {
    requested = true;
    negative = inNegative;
  }
  // Its mover leaves it: it brakes to a standstill, and its motion is reported until then.
  void leave(double acceleration) {
    mover = Mover::None;
    motion.stop(acceleration);
  }
};

} // namespace rung::io
