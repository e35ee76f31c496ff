// Pins that the maps of tests connect, in lines of their own before what connects them.
#pragma once
#include <string_view>

namespace rung::host::testing {

inline constexpr std::string_view kPins = R"([in]
start = { type = "bit", name = "X0.0" }
speed = { type = "s32", name = "D0:2" }
load = { type = "float", name = "D4:4" }
keys = { type = "u32", name = "X10" }
ok = { type = "bit", name = "X0.1" }
[out]
lamp = { type = "bit", name = "Y0.0" }
turns = { type = "s32", name = "D8:2" }
[io]
mode = { type = "s32", name = "D20:4" }
[param]
delay = { type = "u32", name = "D30:2" }
)";

} // namespace rung::host::testing
