// PLC axis control of the simulated CNC: executes the program's commands (GSK's man. §9.2, l.7566-8289;
// rtlib/nc/control/pmc/axis_groups.h) for axes that a parameter assigns to a group and EAX gives to the PLC.
#pragma once
#include <array>

#include "rtlib/nc/control/pmc/axis_groups.h"
#include "sim/pmc/machine.h"

namespace rung::sim::pmc {

class PlcAxes {
public:
  // The model outlives it.
  explicit PlcAxes(const nc::pmc::Model& model) : groups_(model) {}

  void step(const nc::pmc::SignalsIo& io, Machine& machine, bool emergencyStop);

  template <class Archive>
  void state(Archive& archive) {
    archive(groups_, target_);
  }

private:
  class Mover; // the state of one slot

  nc::PmcAxisGroups groups_;
  std::array<int64_t, kAxes> target_ = {};
};

} // namespace rung::sim::pmc
