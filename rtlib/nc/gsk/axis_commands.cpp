// Commands and groups of PLC axis control (see axis_commands.h).
#include "rtlib/nc/gsk/axis_commands.h"

namespace rung::nc::gsk {
namespace {

// P54: 0.1 um and 0.0001 mm are the same; only l.3310 has 0.001 mm.
constexpr auto kCommands = pmc::axisCommandsWith({.rapid = {"rapid speed", "mm/min or deg/min", 1, UINT16_MAX},
                                                  .feedPerTurn = "0.0001 mm/rev or deg/rev",
                                                  .length = "0.1 um"});

constexpr pmc::AxisGroup kGroups[] = {
    {'A', 142, 143, 130, 131, 132, 150, 151}, {'B', 154, 155, 133, 134, 135, 162, 163},
    {'C', 166, 167, 136, 137, 138, 174, 175}, {'D', 178, 179, 139, 140, 141, 186, 0},
    {'E', 187, 188, 142, 143, 144, 0, 0},     {'F', 196, 197, 145, 146, 147, 0, 0},
    {'G', 205, 206, 148, 149, 150, 0, 0},     {'H', 214, 215, 151, 152, 153, 0, 0},
};

} // namespace

std::span<const pmc::AxisCommand> axisCommands() { return kCommands; }

std::span<const pmc::AxisGroup> axisGroups() { return kGroups; }

} // namespace rung::nc::gsk
