// Reads the sources of a program, including included files, with the rights of the running process.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "machine/compile/sources.h"

namespace rung::rung_compile {

struct Collected {
  std::optional<compile::Sources> sources; // nothing: `report` has the reason
  std::string report;                      // errors as rungc prints them
  std::string diagnostics;                 // the same as JSON; "" if no source has an error
  bool unreadable = false;                 // a named file cannot be read
};

// `names`: files in their order, or one project folder or project file. Files that all belong to one project are
// compiled as that project, as by rungc.
Collected collect(const std::vector<std::string>& names, bool color = false);

} // namespace rung::rung_compile
