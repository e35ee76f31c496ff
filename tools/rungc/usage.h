// Help, and what is said about a wrong command line: one line with the word that was meant.
#pragma once
#include <CLI/CLI.hpp>

namespace rung::rungc {

// Prints what is wrong and gives kUsage.
int wrongUsage(const CLI::App& app, const CLI::ParseError& error);

} // namespace rung::rungc
