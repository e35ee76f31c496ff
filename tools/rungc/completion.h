// Completion of command lines in shells, from the description of the command line.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace rung::rungc {

std::string bashCompletion(const CLI::App& app);
std::string zshCompletion(const CLI::App& app);

} // namespace rung::rungc
