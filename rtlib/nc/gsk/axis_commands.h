// PLC axis control of the GSK25i: the commands of AXLCTL and the groups A-H (man. Table 9-2, l.7713-7803; groups
// l.3332-3372, 7591-7629).
#pragma once
#include "rtlib/nc/pmc/axis_commands.h"

namespace rung::nc::gsk {

// In the order of their codes.
std::span<const pmc::AxisCommand> axisCommands();
// Group number n is element n - 1: 1 is group A (man. l.3281-3285, 8260-8275; E-H by P50).
std::span<const pmc::AxisGroup> axisGroups();

} // namespace rung::nc::gsk
