// Manual pages, from what --help says.
#pragma once
#include <string>

#include "tools/rungc/command_line.h"

namespace rung::rungc {

// Of a command, or of rungc itself where `command` is its root; for man(1).
std::string manualPage(const CommandLine& app, Command command);

} // namespace rung::rungc
