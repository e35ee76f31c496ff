// Commands and groups of PLC axis control (see axis_commands.h).
#include "rtlib/nc/gsk/axis_commands.h"

#include <iterator>

namespace rung::nc::gsk {
namespace {

using namespace pmc;
using enum AxisBuffering;

constexpr AxisField kNone = {};
constexpr AxisField kRapid = {"rapid speed", "mm/min or deg/min", 1, UINT16_MAX};
constexpr AxisField kFeed = {"feed", "mm/min or deg/min", 1, UINT16_MAX};
constexpr AxisField kFeedPerTurn = {"feed", "0.0001 mm/rev or deg/rev", 1, UINT16_MAX};
constexpr AxisField kJogFeed = {"speed", "mm/min or deg/min", 1, UINT16_MAX};
constexpr AxisField kTurns = {"speed", "r/min", INT16_MIN, INT16_MAX};
// P54: 0.1 um and 0.0001 mm are the same; only l.3310 has 0.001 mm.
constexpr AxisField kDistance = {"distance, incremental", "0.1 um", INT32_MIN, INT32_MAX};
constexpr AxisField kCoordinate = {"machine coordinate", "0.1 um", INT32_MIN, INT32_MAX};
constexpr AxisField kTime = {"time", "ms", 1, 9'999'999};
constexpr AxisField kDirection = {"direction: 0 positive, 1 negative", "", 0, 1};
constexpr AxisField kCode = {"code of the auxiliary function", "", 0, UINT8_MAX};

constexpr AxisCommand kCommands[] = {
    {0, "rapid (G00)", Buffered, kRapid, kDistance, 7714, 8293},
    {1, "cutting feed per minute (G94 G01)", Buffered, kFeed, kDistance, 7715, 8305},
    {2, "cutting feed per revolution (G95 G01)", Buffered, kFeedPerTurn, kDistance, 7716, 8315},
    {3, "skip, feed per minute (G31 G01)", Alone, kFeed, kDistance, 7717, 8325},
    {4, "dwell (G04)", Buffered, kNone, kTime, 7718, 8335},
    {5, "manual reference point return", Alone, kNone, kNone, 7719, 8345},
    {6, "continuous feed (JOG)", Immediate, kJogFeed, kDirection, 7722, 8397},
    {7, "reference point 1 (G28)", Alone, kRapid, kNone, 7723, 8355},
    {8, "reference point 2 (G30 P2)", Alone, kRapid, kNone, 7724, 8365},
    {9, "reference point 3 (G30 P3)", Alone, kRapid, kNone, 7725, 8377},
    {10, "reference point 4 (G30 P4)", Alone, kRapid, kNone, 7726, 8387},
    {16, "speed command (M3 S)", Immediate, kTurns, kNone, 7727, 8407},
    {18, "auxiliary function 1", Buffered, kNone, kCode, 7728, 8427},
    {20, "auxiliary function 2", Buffered, kNone, kCode, 7729, 8442},
    {21, "auxiliary function 3", Buffered, kNone, kCode, 7730, 8457},
    {32, "machine coordinates (G53)", Alone, kRapid, kCoordinate, 7731, 8472},
};

constexpr bool isSound() {
  for (size_t i = 1; i < std::size(kCommands); ++i)
    if (kCommands[i].code <= kCommands[i - 1].code) return false;
  return true;
}
static_assert(isSound(), "an axis command is out of order");

constexpr AxisGroup kGroups[] = {
    {'A', 142, 143, 130, 131, 132, 150, 151}, {'B', 154, 155, 133, 134, 135, 162, 163},
    {'C', 166, 167, 136, 137, 138, 174, 175}, {'D', 178, 179, 139, 140, 141, 186, 0},
    {'E', 187, 188, 142, 143, 144, 0, 0},     {'F', 196, 197, 145, 146, 147, 0, 0},
    {'G', 205, 206, 148, 149, 150, 0, 0},     {'H', 214, 215, 151, 152, 153, 0, 0},
};

} // namespace

std::span<const pmc::AxisCommand> axisCommands() { return kCommands; }

std::span<const pmc::AxisGroup> axisGroups() { return kGroups; }

} // namespace rung::nc::gsk
