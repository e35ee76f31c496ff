// Which scenarios a command runs: files, folders with all that lies below, and a filter.
#pragma once
#include <string>
#include <vector>

#include "ir/support/result.h"

namespace rung::rungc {

// Files stay in their order; a folder gives every *.scn below it, sorted. Fails when a folder has none, or when a name
// is that of a program.
Result<std::vector<std::string>> scenarioFiles(const std::vector<std::string>& names);

// Those whose path contains one of the texts; a text with *, ? or [ is a pattern for the whole path or the file's name.
std::vector<std::string> filtered(const std::vector<std::string>& files, const std::vector<std::string>& filters);

} // namespace rung::rungc
