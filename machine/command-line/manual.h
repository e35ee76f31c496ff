// Manual pages, from what --help says.
#pragma once
#include <string>

#include "machine/command-line/command_line.h"

namespace rung::cli {

// Of a command, or of the program where `command` is its root; for man(1).
std::string manualPage(const CommandLine& app, Command command);

} // namespace rung::cli
