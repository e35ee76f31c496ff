// Sections of the reference page besides the instructions, from the same tables that the compiler and the simulated CNC
// use.
#pragma once
#include "frontend/table/reference.h"

namespace rung::frontend::gsk {

// Areas, limits, pins, warnings, window functions, PLC axis commands, signals.
void addReference(frontend::ReferencePage& page);

} // namespace rung::frontend::gsk
