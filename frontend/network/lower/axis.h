// PLC axis control: passes command blocks to the CNC through the signals of a group (§9).
#pragma once
#include <cstdint>
#include <functional>
#include <span>

#include "frontend/network/lower/lower_function.h"
#include "rtlib/nc/pmc/axis_commands.h"

namespace rung::frontend::network {

// An instruction with the conditions RST, ACT, and the block of the command as its second parameter.
struct AxisControl {
  const nc::pmc::AxisGroup& group;
  std::span<const nc::pmc::AxisCommand> commands;
  Area g{}, f{};       // areas of the signals
  uint32_t offset = 0; // of the path, in both
  // Stores the error of a command: whether it is unknown.
  std::function<void(ir::ValueId isUnknown)> report;
};
void controlAxes(Lowering& f, const AxisControl& control);

} // namespace rung::frontend::network
