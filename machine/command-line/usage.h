// Help, completion, and messages about a wrong command line: one line with the word that was probably meant.
#pragma once
#include <string>

#include "machine/command-line/command_line.h"

namespace rung::cli {

// The message for standard error; the list of commands if there are no words at all.
std::string wrongUsage(const CommandLine& app, const WrongWords& words);

// Adds the commands `completion` and `help` after all others. A program without commands gets a flag --man.
void addUsage(CommandLine& app, int& status);

} // namespace rung::cli
