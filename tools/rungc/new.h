// A small complete project to begin with.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/result.h"

namespace rung::rungc {

// Writes program, scenario, project file and .gitignore of this dialect into a folder that is empty or does not exist;
// gives the files. Fails with a text for the user.
Result<std::vector<std::string>> makeProject(std::string_view dialect, const std::string& folder);

} // namespace rung::rungc
