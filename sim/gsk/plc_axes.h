// PLC axis control of the simulated CNC: moves the axes that parameter 7010 gives to a group and EAX hands over, by the
// commands of the program (man. §9.2, l.7566-8289; rtlib/nc/control/gsk/axis_groups.h).
#pragma once
#include <array>

#include "rtlib/nc/control/gsk/axis_groups.h"
#include "sim/gsk/machine.h"

namespace rung::sim::gsk {

class PlcAxes {
public:
  void step(const nc::gsk::SignalsIo& io, Machine& machine, bool emergencyStop);

private:
  class Mover; // the machine in a slot

  nc::GskAxisGroups groups_;
  std::array<int64_t, kAxes> target_ = {};
};

} // namespace rung::sim::gsk
