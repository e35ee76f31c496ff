// Sections of the reference page besides the instructions, and the meaning of single words; from the same tables that
// the compiler and the simulated NC use.
#pragma once
#include <string>
#include <string_view>

#include "frontend/table/reference.h"

namespace rung::frontend::nct {

// Memory, pins, warnings, services of the NC, signals.
void addReference(frontend::ReferencePage& page);

// The text about a signal of the NC, a flag, a quantity of SCP, or a function such as "MW 70"; "" for anything else.
std::string explainWord(std::string_view word);

} // namespace rung::frontend::nct
