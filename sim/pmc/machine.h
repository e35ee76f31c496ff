// State shared by the parts of the simulated CNC: tables, axes, spindles, alarms, and the rules for speeds.
#pragma once
#include <algorithm>

#include "sim/pmc/axes.h"
#include "sim/pmc/spindle.h"
#include "sim/pmc/tables.h"

namespace rung::sim::pmc {

struct Machine {
  // The table of the CNC outlives it.
  explicit Machine(const Cnc& of) : cnc(&of), tables(of), axes(of) {}

  const Cnc* cnc;
  Tables tables;
  Axes axes;
  Spindle spindle;
  Alarms alarms;
  uint8_t plcAxes = 0;       // bit n-1: axis n belongs to the PLC (EAXn)
  bool messageAlarm = false; // a message of the program is an alarm
  bool rapid = false;        // the motion that began last was rapid (l.5607)

  bool hasAlarm() const { return alarms.any() || messageAlarm; }
  bool isPlcAxis(uint32_t axis) const { return ((plcAxes >> axis) & 1) != 0; }
  // Whether there is such a macro variable, and it may be read.
  bool isMacro(uint32_t number) const;
  int64_t macro(uint32_t number, const nc::pmc::SignalsIo& io) const;
  void setMacro(uint32_t number, int64_t value, const nc::pmc::SignalsIo& io);

  template <class Archive>
  void state(Archive& archive) {
    archive(tables, axes, spindle, alarms, plcAxes, messageAlarm, rapid);
  }
};

// G12: 0-254 %, 255 counts as 0 (l.5693-5701).
inline double feedOverride(const Cnc& cnc, const nc::pmc::SignalsIo& io) {
  if (cnc.cancelsOverride && io.g(6, 4)) return 1;
  return nc::pmc::overridePercent(*cnc.model, io.gByte(12)) / 100.0;
}

// The two bits of a rapid override: 0 F0, 1 25 %, 2 50 %, 3 100 %.
inline int rapidStep(const Cnc& cnc, uint8_t signals) { return (cnc.model->inverted ? ~signals : signals) & 3; }

// Rapid speed of an axis in mm/min with its override (l.5626-5676) and the safe speed of FVL (l.5725).
inline double rapidSpeed(const nc::pmc::SignalsIo& io, const Machine& machine, uint32_t axis, uint32_t parameter) {
  const Cnc& cnc = *machine.cnc;
  const Tables& tables = machine.tables;
  const double full = tables.parameterReal(parameter, axis);
  double speed = full;
  if (io.g(96, 7)) {
    const int percent = (cnc.model->inverted ? ~io.gByte(96) : io.gByte(96)) & 0x7F;
    speed = full * (cnc.model->inverted && percent > 100 ? 0 : std::min(percent, 100)) / 100.0;
  } else {
    switch (rapidStep(cnc, io.gByte(14))) {
    case 0: speed = std::min(full, tables.parameterReal(cnc.parameters.rapidF0, axis)); break;
    case 1: speed = full / 4; break;
    case 2: speed = full / 2; break;
    default: break;
    }
  }
  const bool isSafe = cnc.parameters.safeFeed != 0 && io.g(19, 6);
  return isSafe ? std::min(speed, tables.parameterReal(cnc.parameters.safeFeed, axis)) : speed;
}

} // namespace rung::sim::pmc
