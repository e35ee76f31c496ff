// Which scenarios a command runs: files, folders with all that lies below, and a filter.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace rung::rungc {

// Files stay in their order; a folder gives the scenarios of the project in it, or every *.scn below it, sorted; no
// name at all those of the project of the working directory. Nothing, and `status` says why, when a folder has none, or
// when a name is that of a program.
std::optional<std::vector<std::string>> scenarioFiles(const std::vector<std::string>& names, int& status);

// Those whose path contains one of the texts; a text with *, ? or [ is a pattern for the whole path or the file's name.
std::vector<std::string> filtered(const std::vector<std::string>& files, const std::vector<std::string>& filters);

} // namespace rung::rungc
