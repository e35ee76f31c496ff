// Reads the sources of a program and the files that they include, with the rights of the calling process.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "machine/compile/sources.h"

namespace rung::rung_compile {

struct Collected {
  std::optional<Sources> sources; // nothing: see `report`
  std::string report;             // errors as rungc prints them
  std::string diagnostics;        // the same as JSON; "" if no source has an error
  bool unreadable = false;        // a named file cannot be read
};

// `names`: files in their order, or one folder of a project or project file. Files that all belong to a project are
// compiled as that project, as by rungc.
Collected collect(const std::vector<std::string>& names, bool color = false);

} // namespace rung::rung_compile
