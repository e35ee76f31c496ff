// Completion of command lines in shells, from the description of the command line.
#pragma once
#include <string>

#include "tools/rungc/command_line.h"

namespace rung::rungc {

std::string bashCompletion(const CommandLine& app);
std::string zshCompletion(const CommandLine& app);

} // namespace rung::rungc
