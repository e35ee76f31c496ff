// What the reference page says beyond the instructions, and what single words mean; from the same tables that the
// compiler and the simulated NC read.
#pragma once
#include <string>
#include <string_view>

namespace rung::nct {

// Markdown: memory, pins, configuration, warnings, services of the NC, signals.
std::string referenceSections();

// A signal of the NC, a flag, a quantity of SCP, a function such as "MW 70"; "" for anything else.
std::string explainWord(std::string_view word);

} // namespace rung::nct
