// Help, completion, and what is said about a wrong command line: one line with the word that was meant.
#pragma once
#include <string>

#include "machine/command-line/command_line.h"

namespace rung::cli {

// What is wrong, for standard error; where there are no words at all, the list of commands.
std::string wrongUsage(const CommandLine& app, const WrongWords& words);

// The commands `completion` and `help`, the last of the program. One without commands has a flag --man.
void addUsage(CommandLine& app, int& status);

} // namespace rung::cli
