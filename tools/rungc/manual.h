// Manual pages, from what --help says.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace rung::rungc {

// Of a command, or of rungc itself where `command` is `app`; for man(1).
std::string manualPage(const CLI::App& app, const CLI::App& command);

} // namespace rung::rungc
