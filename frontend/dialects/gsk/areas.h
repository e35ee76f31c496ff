// Address areas of the GSK25i PLC (man. Part I §3, l.564-805).
#pragma once
#include <algorithm>
#include <array>

#include "frontend/network/address.h"

namespace rung::frontend::gsk {

// R1000-R1099 belong to the control (man. l.740); the first six are the result registers (P4, P22).
inline constexpr uint32_t kSystemRelays = 1000;
inline constexpr uint32_t kResultFlags = 1000;
inline constexpr uint32_t kRemainder = 1002;
inline constexpr uint32_t kResultBytes = 6;

// The areas and what is retained through power-off: man. l.732-790. Presets are all of T and the first two bytes of
// every counter in C (P8, P9).
inline constexpr std::array<network::AreaInfo, 10> kAreas = {{
    {.letter = 'X', .bytes = 128, .use = network::AreaUse::Input, .doc = "machine to PLC"},
    {.letter = 'Y', .bytes = 128, .use = network::AreaUse::Output, .doc = "PLC to machine"},
    {.letter = 'F', .bytes = 256, .use = network::AreaUse::Input, .doc = "CNC to PLC"},
    {.letter = 'G', .bytes = 256, .use = network::AreaUse::Output, .doc = "PLC to CNC"},
    {.letter = 'R', .bytes = 1100, .doc = "intermediate relays", .system = kSystemRelays},
    {.letter = 'D', .bytes = 1860, .retained = true, .doc = "data registers"},
    {.letter = 'C',
     .bytes = 400,
     .retained = true,
     .doc = "counters: preset and value, two bytes each",
     .presets = {2, 4},
     .instead = "a counter is `FUNC CTR` with its number in a PRM line; the OUT after it shows that it is done"},
    {.letter = 'T',
     .bytes = 200,
     .retained = true,
     .doc = "timer presets, two bytes each",
     .presets = {1, 1},
     .instead = "a timer is `FUNC TMRB` with its number and its milliseconds in PRM lines; the OUT after it shows that "
                "the time is over"},
    {.letter = 'A', .bytes = 32, .doc = "message display requests", .shown = true},
    {.letter = 'K', .bytes = 32, .retained = true, .doc = "keep relays"},
}};

namespace areas {

consteval network::Area named(char letter) {
  return static_cast<network::Area>(std::ranges::find(kAreas, letter, &network::AreaInfo::letter) - kAreas.begin());
}

inline constexpr network::Area kX = named('X');
inline constexpr network::Area kF = named('F');
inline constexpr network::Area kG = named('G');
inline constexpr network::Area kR = named('R');
inline constexpr network::Area kD = named('D');
inline constexpr network::Area kC = named('C');
inline constexpr network::Area kT = named('T');
inline constexpr network::Area kA = named('A');

} // namespace areas

} // namespace rung::frontend::gsk
