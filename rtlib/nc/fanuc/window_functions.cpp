// The list of window functions (see window_functions.h).
#include "rtlib/nc/fanuc/window_functions.h"

#include <iterator>

namespace rung::nc::fanuc {
namespace {

using namespace pmc;
using enum WindowAccess;
using enum WindowSpeed;

constexpr WindowField kToolOffset = {"offset number", 1, kNoLimit};
constexpr WindowField kOffsetKind = {"mill: 0 radius wear, 1 radius, 2 length wear, 3 length", 0, 9};
constexpr WindowField kOrigin = {"0 external, 1-6 G54-G59, 7-54 G54.1 P1-P48", 0, kNoLimit};
constexpr WindowField kParameter = {"parameter number", 0, kNoLimit};
constexpr WindowField kVariable = {"variable number", 0, kNoLimit};
constexpr WindowField kAxis = {"axis, 1 the first; -1 all", 1, kNoLimit};
constexpr WindowField kAxisOrNone = {"0; of an axis parameter the axis, 1 the first; -1 all", 0, kNoLimit};
constexpr WindowField kPlaces = {"decimal places of the value", 0, 7};
constexpr WindowField kClock = {"0 date, 1 time, -1 both", 0, kNoLimit};

struct Data {
  WindowField number = {}, attribute = {};
  uint32_t scale = 1;
};
constexpr WindowFunction open(uint16_t code, std::string_view title, WindowAccess access, WindowSpeed speed,
                              Data data = {}) {
  return {.code = code,
          .title = title,
          .access = access,
          .speed = speed,
          .number = data.number,
          .attribute = data.attribute,
          .scale = data.scale};
}
constexpr WindowFunction closed(uint16_t code, std::string_view title, WindowAccess access, WindowSpeed speed) {
  return {.code = code, .title = title, .access = access, .speed = speed, .status = WindowStatus::ClosedInSection};
}

constexpr uint32_t kMicrometres = 1000; // in a mm

constexpr WindowFunction kFunctions[] = {
    open(0, "type, versions and number of axes of the CNC, 14 characters", Read, High),
    open(13, "tool offset", Read, Low, {kToolOffset, kOffsetKind, kMicrometres}),
    open(14, "tool offset", Write, Low, {kToolOffset, kOffsetKind, kMicrometres}),
    open(15, "workpiece origin offset", Read, Low, {kOrigin, kAxis, kMicrometres}),
    open(16, "workpiece origin offset", Write, Low, {kOrigin, kAxis, kMicrometres}),
    open(17, "parameter", Read, Low, {kParameter, kAxisOrNone}),
    open(18, "parameter", Write, Low, {kParameter, kAxisOrNone}),
    closed(19, "setting data", Read, Low),
    closed(20, "setting data", Write, Low),
    open(21, "macro variable: value (4 bytes), decimal places (2 bytes)", Read, Low, {kVariable, kPlaces}),
    open(22, "macro variable: value (4 bytes), decimal places (2 bytes)", Write, Low, {kVariable, kPlaces}),
    open(23, "alarm state", Read, High),
    open(24, "number of the program in execution", Read, High),
    open(25, "sequence number", Read, High),
    open(26, "actual feed", Read, High),
    open(27, "absolute position", Read, High, {{}, kAxis, kMicrometres}),
    open(28, "machine position", Read, High, {{}, kAxis, kMicrometres}),
    closed(29, "skip position", Read, High),
    closed(32, "modal data", Read, High),
    closed(33, "diagnosis data", Read, Low),
    closed(34, "load current of a servo motor", Read, High),
    closed(45, "cutter compensation number of a tool group", Read, Low),
    open(50, "actual spindle speed", Read, High),
    closed(59, "P-code macro variable", Read, Low),
    closed(60, "P-code macro variable", Write, Low),
    open(74, "relative position", Read, High, {{}, kAxis, kMicrometres}),
    open(75, "distance to go", Read, High, {{}, kAxis, kMicrometres}),
    closed(150, "program check screen", Write, Low),
    open(151, "date and time of the clock", Read, Low, {{}, kClock}),
    closed(152, "torque limit", Write, Low),
    open(153, "load of a spindle motor", Read, High),
    open(154, "parameter, at high speed", Read, High, {kParameter, kAxisOrNone}),
    closed(207, "diagnosis of servo or spindle speed", Read, High),
    closed(367, "magazine shift", Write, Low),
};

constexpr bool isSound() {
  for (size_t i = 1; i < std::size(kFunctions); ++i)
    if (kFunctions[i].code <= kFunctions[i - 1].code) return false;
  return true;
}
static_assert(isSound(), "a window function is out of order");

} // namespace

std::span<const pmc::WindowFunction> windowFunctions() { return kFunctions; }

} // namespace rung::nc::fanuc
