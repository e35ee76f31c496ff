// Commands and groups of PMC axis control (see axis_commands.h). The codes are those of the GSK25i, which follows
// FANUC's; programs of machines have 5, 6 and 16. Lengths are in the least increment of the CNC.
#include "rtlib/nc/fanuc/axis_commands.h"

namespace rung::nc::fanuc {
namespace {

using namespace pmc;
using enum AxisBuffering;

constexpr AxisField kNone = {};
constexpr AxisField kRapid = {"rapid speed; 0: that of the parameter", "mm/min or deg/min", 0, UINT16_MAX};
constexpr AxisField kFeed = {"feed", "mm/min or deg/min", 1, UINT16_MAX};
constexpr AxisField kFeedPerTurn = {"feed", "0.01 mm/rev or deg/rev", 1, UINT16_MAX};
constexpr AxisField kJogFeed = {"speed", "mm/min or deg/min", 1, UINT16_MAX};
constexpr AxisField kTurns = {"speed", "r/min", INT16_MIN, INT16_MAX};
constexpr AxisField kDistance = {"distance, incremental", "0.001 mm", INT32_MIN, INT32_MAX};
constexpr AxisField kCoordinate = {"machine coordinate", "0.001 mm", INT32_MIN, INT32_MAX};
constexpr AxisField kTime = {"time", "ms", 1, 9'999'999};
constexpr AxisField kDirection = {"direction: 0 positive, 1 negative", "", 0, 1};
constexpr AxisField kCode = {"code of the auxiliary function", "", 0, UINT8_MAX};

constexpr AxisCommand kCommands[] = {
    {.code = 0, .title = "rapid", .buffering = Buffered, .data1 = kRapid, .data2 = kDistance},
    {.code = 1, .title = "cutting feed per minute", .buffering = Buffered, .data1 = kFeed, .data2 = kDistance},
    {.code = 2,
     .title = "cutting feed per revolution",
     .buffering = Buffered,
     .data1 = kFeedPerTurn,
     .data2 = kDistance},
    {.code = 3, .title = "skip, feed per minute", .buffering = Alone, .data1 = kFeed, .data2 = kDistance},
    {.code = 4, .title = "dwell", .buffering = Buffered, .data1 = kNone, .data2 = kTime},
    {.code = 5, .title = "manual reference point return", .buffering = Alone, .data1 = kNone, .data2 = kNone},
    {.code = 6, .title = "continuous feed", .buffering = Immediate, .data1 = kJogFeed, .data2 = kDirection},
    {.code = 7, .title = "reference point 1", .buffering = Alone, .data1 = kRapid, .data2 = kNone},
    {.code = 8, .title = "reference point 2", .buffering = Alone, .data1 = kRapid, .data2 = kNone},
    {.code = 9, .title = "reference point 3", .buffering = Alone, .data1 = kRapid, .data2 = kNone},
    {.code = 10, .title = "reference point 4", .buffering = Alone, .data1 = kRapid, .data2 = kNone},
    {.code = 16, .title = "speed command", .buffering = Immediate, .data1 = kTurns, .data2 = kNone},
    {.code = 18, .title = "auxiliary function 1", .buffering = Buffered, .data1 = kNone, .data2 = kCode},
    {.code = 20, .title = "auxiliary function 2", .buffering = Buffered, .data1 = kNone, .data2 = kCode},
    {.code = 21, .title = "auxiliary function 3", .buffering = Buffered, .data1 = kNone, .data2 = kCode},
    {.code = 32, .title = "machine coordinates", .buffering = Alone, .data1 = kRapid, .data2 = kCoordinate},
};

constexpr AxisGroup kGroups[] = {{'A', 142, 143, 130, 131, 132, 150, 151},
                                 {'B', 154, 155, 133, 134, 135, 162, 163},
                                 {'C', 166, 167, 136, 137, 138, 174, 175},
                                 {'D', 178, 179, 139, 140, 141, 186, 187}};

} // namespace

std::span<const pmc::AxisCommand> axisCommands() { return kCommands; }

std::span<const pmc::AxisGroup> axisGroups() { return kGroups; }

} // namespace rung::nc::fanuc
