// PLC axis control of the simulated CNC: executes the program's commands (man. §9.2, l.7566-8289;
// rtlib/nc/control/gsk/axis_groups.h) for axes that parameter 7010 assigns to a group and EAX gives to the PLC.
#pragma once
#include <array>

#include "rtlib/nc/control/gsk/axis_groups.h"
#include "sim/gsk/machine.h"

namespace rung::sim::gsk {

class PlcAxes {
public:
  void step(const nc::gsk::SignalsIo& io, Machine& machine, bool emergencyStop);

private:
  class Mover; // the state of one slot

  nc::GskAxisGroups groups_;
  std::array<int64_t, kAxes> target_ = {};
};

} // namespace rung::sim::gsk
