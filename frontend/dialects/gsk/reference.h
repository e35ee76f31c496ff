// What the reference page says beyond the instructions, from the same tables that the compiler and the simulated CNC
// read.
#pragma once
#include <string>

namespace rung::gsk {

// Markdown: areas, limits, pins, configuration, warnings, window functions, PLC axis commands, signals.
std::string referenceSections();

} // namespace rung::gsk
