// Manual pages, generated from the help texts.
#pragma once
#include <string>

#include "machine/command-line/command_line.h"

namespace rung::cli {

// The page of a command, or of the program if `command` is its root, in the format of man(1).
std::string manualPage(const CommandLine& app, Command command);

} // namespace rung::cli
