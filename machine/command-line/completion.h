// Shell completion, generated from the description of the command line.
#pragma once
#include <string>

#include "machine/command-line/command_line.h"

namespace rung::cli {

std::string bashCompletion(const CommandLine& app);
std::string zshCompletion(const CommandLine& app);

} // namespace rung::cli
