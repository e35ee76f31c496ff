// Checks a configuration for the compiler and the simulated control of the dialect.
#pragma once
#include <vector>

#include "compiler/configuration.h"

namespace rung::scenario {

// Applies the entries in the given order. Files that they name are looked for in the working directory.
std::vector<compiler::ConfigProblem> checkConfiguration(const frontend::Dialect& dialect, compiler::ConfigPairs config);

} // namespace rung::scenario
