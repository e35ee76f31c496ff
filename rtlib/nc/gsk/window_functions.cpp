// The list of window functions (see window_functions.h).
#include "rtlib/nc/gsk/window_functions.h"

#include <algorithm>
#include <iterator>

namespace rung::nc::gsk {
namespace {

using namespace pmc;
using enum WindowAccess;
using enum WindowSpeed;
using enum WindowStatus;

constexpr uint16_t kLastAxis = 8; // signals of the interface count axes 1-8, e.g. EADEN1-8 (man. l.3368)

constexpr WindowField kToolOffset = {"offset number - 1 (0 is 001)", 0, kNoLimit};
constexpr WindowField kOffsetKind = {"0 H, 1 wear H, 2 D, 3 wear D", 0, 3};
constexpr WindowField kOrigin = {"0 EXT, 1-6 G54-G59, 7-54 G54.1 P1-P48", 0, 54};
constexpr WindowField kAxisFrom0 = {"axis - 1 (0 is X)", 0, kLastAxis - 1};
constexpr WindowField kAxisFrom1 = {"axis (1 is X)", 1, kLastAxis};
constexpr WindowField kParameter = {"parameter number", 0, kNoLimit};
constexpr WindowField kParameterAxis = {"axis - 1 (0 is X); 0 for a parameter without axes", 0, kLastAxis - 1};
constexpr WindowField kVariable = {"variable number", 0, kNoLimit};
constexpr WindowField kWritableVariable = {"variable number", 100, 999};
constexpr WindowField kPitch = {"compensation number", 0, kNoLimit};
constexpr WindowField kPitchWay = {"0 forward, 1 reverse", 0, 1};
constexpr WindowField kTool = {"0 HD.T (current), 1 NX.T (preselected)", 0, 1};

constexpr WindowFunction closed(uint16_t code, std::string_view title, WindowAccess access, WindowSpeed speed,
                                uint16_t listLine) {
  return {.code = code, .title = title, .access = access, .speed = speed, .status = ClosedInList, .listLine = listLine};
}

struct Section {
  std::string_view number;
  uint16_t line;
};
struct Data {
  uint32_t scale = 10000;
  bool wholeOnly = false;
};
constexpr WindowFunction open(uint16_t code, std::string_view title, WindowAccess access, WindowSpeed speed,
                              uint16_t listLine, Section section, WindowField number, WindowField attribute,
                              Data data = {}) {
  return {.code = code,
          .title = title,
          .access = access,
          .speed = speed,
          .status = Open,
          .number = number,
          .attribute = attribute,
          .scale = data.scale,
          .wholeOnly = data.wholeOnly,
          .listLine = listLine,
          .section = section.number,
          .line = section.line};
}

// A function that is "(not open yet)" in its section, but open in the list.
constexpr WindowFunction notYet(WindowFunction function) {
  function.status = ClosedInSection;
  return function;
}

constexpr WindowFunction kFunctions[] = {
    closed(0, "CNC state information", Read, High, 3206),
    open(1, "tool offset", Read, Low, 3207, {"9.3.1", 8686}, kToolOffset, kOffsetKind),
    open(2, "tool offset", Write, Low, 3208, {"9.3.2", 8699}, kToolOffset, kOffsetKind),
    open(3, "workpiece origin offset", Read, Low, 3209, {"9.3.3", 8717}, kOrigin, kAxisFrom0),
    open(4, "workpiece origin offset", Write, Low, 3210, {"9.3.4", 8731}, kOrigin, kAxisFrom0),
    open(5, "parameter", Read, Low, 3211, {"9.3.5", 8747}, kParameter, kParameterAxis),
    open(6, "parameter", Write, Low, 3212, {"9.3.6", 8761}, kParameter, kParameterAxis),
    closed(7, "setting data", Read, Low, 3213),
    closed(8, "setting data", Write, Low, 3214),
    open(9, "user macro variable", Read, Low, 3215, {"9.3.7", 8776}, kVariable, {}),
    open(10, "user macro variable", Write, Low, 3216, {"9.3.8", 8790}, kWritableVariable, {}),
    open(11, "pitch compensation", Read, Low, 3217, {"9.3.9", 8805}, kPitch, kPitchWay),
    open(12, "pitch compensation", Write, Low, 3218, {"9.3.10", 8819}, kPitch, kPitchWay, {10000, true}),
    notYet(open(13, "current program number", Read, High, 3219, {"9.3.11", 8835}, {}, {})),
    open(14, "current sequence number", Read, High, 3220, {"9.3.12", 8849}, {}, {}),
    notYet(open(15, "actual speed of an axis", Read, High, 3221, {"9.3.13", 8863}, {}, kAxisFrom0)),
    closed(16, "absolute coordinates of an axis", Read, High, 3222),
    open(17, "machine coordinates of an axis", Read, High, 3223, {"9.3.14", 8877}, {}, kAxisFrom1, {1000}),
    notYet(open(18, "skip position of an axis", Read, High, 3224, {"9.3.15", 8891}, {}, kAxisFrom0)),
    notYet(open(19, "load current of a feed motor", Read, High, 3225, {"9.3.16", 8905}, {}, kAxisFrom0)),
    notYet(open(20, "motor torque limit", Write, Low, 3226, {"9.3.17", 8919}, {}, kAxisFrom0)),
    closed(21, "actual spindle speed", Read, High, 3227),
    closed(22, "spindle load", Read, High, 3228),
    closed(23, "relative coordinates of an axis", Read, High, 3229),
    closed(24, "remaining movement", Read, High, 3230),
    closed(25, "modal data", Read, Low, 3231),
    closed(26, "diagnostic data", Read, High, 3232),
    closed(28, "time data", Read, Low, 3233),
    closed(29, "P-code macro variable", Read, Low, 3236),
    closed(30, "P-code macro variable", Write, Low, 3237),
    open(31, "tool number", Write, Low, 3238, {"9.3.18", 8933}, kTool, {}, {10000, true}),
    closed(32, "preset of relative coordinates", Write, Low, 3239),
};

constexpr bool isSound() {
  for (size_t i = 1; i < std::size(kFunctions); ++i)
    if (kFunctions[i].code <= kFunctions[i - 1].code) return false;
  return std::ranges::all_of(kFunctions, [](const WindowFunction& f) {
    return !f.title.empty() && f.listLine != 0 && (f.status == ClosedInList) == f.section.empty();
  });
}
static_assert(isSound(), "a window function is out of order or lacks its place in the manual");

} // namespace

std::span<const pmc::WindowFunction> windowFunctions() { return kFunctions; }

} // namespace rung::nc::gsk
