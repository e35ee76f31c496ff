// What the reference page says beyond the instructions, and what single words mean; from the same tables that the
// compiler and the simulated NC read.
#pragma once
#include <string>
#include <string_view>

#include "frontend/table/reference.h"

namespace rung::frontend::nct {

// Memory, pins, warnings, services of the NC, signals.
void addReference(frontend::ReferencePage& page);

// A signal of the NC, a flag, a quantity of SCP, a function such as "MW 70"; "" for anything else.
std::string explainWord(std::string_view word);

} // namespace rung::frontend::nct
