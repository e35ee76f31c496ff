// The list of windows (see windows.h). In the manual the rows of parameter 1 = -1 are one row above their identifier
// (l.4159, l.4164).
#include "rtlib/nc/nct/windows.h"

#include <algorithm>
#include <iterator>

namespace rung::nc::nct {
namespace {

constexpr ScreenWindow kWindows[] = {
    {100, "alphanumerical keyboard", "", "", false, 4155},
    {110, "PLC buttons", "", "", false, 4156},
    {120, "window selection buttons", "", "", false, 4157},
    {130, "machine operation panel", "", "", false, 4158},
    {1000, "G codes", "-1 as set last, 0 active, 1 active with text, 2 all, 3 all with text", "", true, 4160},
    {1010, "M codes", "-1 as set last, 0 active, 1 active with text, 2 all, 3 all with text", "", true, 4165},
    {1020, "FST", "", "", false, 4169},
    {1030, "all the spindles", "", "", false, 4170},
    {1040, "single block input", "", "", false, 4171},
    {1050, "program list", "", "", false, 4172},
    {1090, "left directory window", "", "", false, 4173},
    {1091, "right directory window", "", "", false, 4174},
    {1110, "list of programs running (main programs and subprograms)", "", "", false, 4175},
    {1130, "all the messages", "", "", false, 4178},
    {1150, "time/workpiece counter", "", "", false, 4179},
    {3000, "position", "", "", false, 4180},
    {3011, "workpiece probing", "", "", false, 4181},
    {3012, "tool probing", "", "", false, 4182},
    {3020, "tool compensation table for milling machine", "", "", false, 4183},
    {3031, "tool compensation table for lathe", "", "", false, 4184},
    {3032, "tool compensation table 2 for lathe", "", "", false, 4185},
    {3040, "zero point offset window", "", "", false, 4186},
    {4010, "tool management table", "", "", false, 4187},
    {4020, "tool pocket table", "", "", false, 4188},
    {4030, "particular window for tool construction", "magazine number", "pocket number", false, 4189},
    {4040, "tool shape table", "", "", false, 4190},
    {4050, "aggregate tool life table", "", "", false, 4191},
    {5010, "#1...#33 local macro variables", "", "", false, 4192},
    {5020, "#100...#499 global macro variables", "", "", false, 4193},
    {5030, "#500...#999 global macro variables", "", "", false, 4194},
    {6000, "calculator", "", "", false, 4195},
    {6010, "cutting speed calculation", "", "", false, 4196},
    {6020, "division counter", "", "", false, 4197},
    {6030, "DXF converter", "", "", false, 4198},
    {6040, "setting the spindle orientation position", "", "", false, 4199},
    {6041, "setting the spindle phase shift", "", "", false, 4200},
    {6060, "workpiece probe calibration", "", "", false, 4201},
    {6061, "workpiece surface measurement", "", "", false, 4202},
    {6062, "workpiece corner measurement", "", "", false, 4203},
    {6063, "workpiece pocket/web, bore/boss measurement", "", "", false, 4208},
};

constexpr bool isSound() {
  for (size_t i = 1; i < std::size(kWindows); ++i)
    if (kWindows[i].identifier <= kWindows[i - 1].identifier) return false;
  return true;
}
static_assert(isSound(), "windows are out of order");

} // namespace

std::span<const ScreenWindow> screenWindows() { return kWindows; }

const ScreenWindow* findScreenWindow(int64_t identifier) {
  const auto found = std::ranges::lower_bound(kWindows, identifier, {}, &ScreenWindow::identifier);
  return found != std::end(kWindows) && found->identifier == identifier ? &*found : nullptr;
}

} // namespace rung::nc::nct
