// Reads the sources of a program, and what they include, with the rights of the process that runs it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "machine/compile/sources.h"

namespace rung::rung_compile {

struct Collected {
  std::optional<compile::Sources> sources; // nothing: `report` says why
  std::string report;                      // errors as rungc prints them
  std::string diagnostics;                 // the same as JSON; "" where nothing is wrong in a source
  bool unreadable = false;                 // a file that is named cannot be read
};

// `names`: files in their order, or one folder of a project or project file. Files that all belong to a project are
// compiled as that project, as by rungc.
Collected collect(const std::vector<std::string>& names, bool color = false);

} // namespace rung::rung_compile
