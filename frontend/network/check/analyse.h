// Rules across the networks of a program: labels, regions, calls, coils.
#pragma once
#include "frontend/network/program.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::network {

// Resolves labels, regions and calls, and reports mistakes in them. `incomplete`: see UnitAssembler.
void analyse(Context& context, Program& program, bool incomplete);

// Part of analyse(): bits that several coils write. For programs without errors; `calleesFirst` has all units.
void checkCoils(Context& context, const Program& program, const std::vector<uint32_t>& calleesFirst);

} // namespace rung::frontend::network
