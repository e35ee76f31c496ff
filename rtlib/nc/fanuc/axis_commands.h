// PMC axis control of the FANUC PMC: the commands of AXCTL and the groups A-D of path 1.
#pragma once
#include "rtlib/nc/pmc/axis_commands.h"

namespace rung::nc::fanuc {

// In the order of their codes.
std::span<const pmc::AxisCommand> axisCommands();
// Group number n of AXCTL is element n - 1: 1 is group A.
std::span<const pmc::AxisGroup> axisGroups();

} // namespace rung::nc::fanuc
