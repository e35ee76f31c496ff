// Checks a configuration as the compiler and the simulated control of the dialect read it.
#pragma once
#include <vector>

#include "compiler/configuration.h"

namespace rung::scenario {

// In the order given, as the control reads them. Files of the control lie in the current folder.
std::vector<compiler::ConfigProblem> checkConfiguration(const frontend::Dialect& dialect, compiler::ConfigPairs config);

} // namespace rung::scenario
