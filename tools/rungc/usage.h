// Help, and what is said about a wrong command line: one line with the word that was meant.
#pragma once
#include "tools/rungc/command_line.h"

namespace rung::rungc {

// Prints what is wrong and gives kUsage.
int wrongUsage(const CommandLine& app, const WrongWords& words);

} // namespace rung::rungc
