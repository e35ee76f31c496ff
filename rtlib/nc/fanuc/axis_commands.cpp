// Commands and groups of PMC axis control (see axis_commands.h). Lengths are in the least increment of the CNC.
#include "rtlib/nc/fanuc/axis_commands.h"

namespace rung::nc::fanuc {
namespace {

constexpr auto kCommands =
    pmc::axisCommandsWith({.rapid = {"rapid speed; 0: that of the parameter", "mm/min or deg/min", 0, UINT16_MAX},
                           .feedPerTurn = "0.01 mm/rev or deg/rev",
                           .length = "0.001 mm"});

constexpr pmc::AxisGroup kGroups[] = {{'A', 142, 143, 130, 131, 132, 150, 151},
                                      {'B', 154, 155, 133, 134, 135, 162, 163},
                                      {'C', 166, 167, 136, 137, 138, 174, 175},
                                      {'D', 178, 179, 139, 140, 141, 186, 187}};

} // namespace

std::span<const pmc::AxisCommand> axisCommands() { return kCommands; }

std::span<const pmc::AxisGroup> axisGroups() { return kGroups; }

} // namespace rung::nc::fanuc
