// State shared by the parts of the simulated CNC: tables, axes, spindles, alarms, and the rules for speeds.
#pragma once
#include <algorithm>

#include "sim/gsk/axes.h"
#include "sim/gsk/spindle.h"
#include "sim/gsk/tables.h"

namespace rung::sim::gsk {

struct Machine {
  Tables tables;
  Axes axes;
  Spindle spindle;
  Alarms alarms;
  uint8_t plcAxes = 0; // bit n-1: axis n belongs to the PLC (EAXn)
  bool rapid = false;  // the motion that began last was rapid (l.5607)

  bool isPlcAxis(uint32_t axis) const { return ((plcAxes >> axis) & 1) != 0; }
  int64_t macro(uint32_t number, const nc::gsk::SignalsIo& io) const;
  void setMacro(uint32_t number, int64_t value, const nc::gsk::SignalsIo& io);
};

// G12: 0-254 %, 255 counts as 0 (l.5693-5701).
inline double feedOverride(const nc::gsk::SignalsIo& io) {
  const uint8_t percent = io.gByte(12);
  return percent == 255 ? 0 : percent / 100.0;
}

// Rapid speed of an axis in mm/min with its override (l.5626-5676) and the safe speed of FVL (l.5725).
inline double rapidSpeed(const nc::gsk::SignalsIo& io, const Tables& tables, uint32_t axis,
                         uint32_t parameter = kParamRapid) {
  const double full = tables.parameterReal(parameter, axis);
  double speed = full;
  if (io.g(96, 7)) {
    speed = full * std::min(io.gByte(96) & 0x7F, 100) / 100.0;
  } else {
    switch (io.gByte(14) & 3) {
    case 0: speed = std::min(full, tables.parameterReal(kParamRapidF0)); break;
    case 1: speed = full / 4; break;
    case 2: speed = full / 2; break;
    default: break;
    }
  }
  return io.g(19, 6) ? std::min(speed, tables.parameterReal(kParamSafeFeed, axis)) : speed;
}

} // namespace rung::sim::gsk
