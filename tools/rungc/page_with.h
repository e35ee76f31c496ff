// A program's page with what has been found out about it: on its drawing, or on its source where its dialect has none.
#pragma once
#include <string>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "ir/support/result.h"
#include "tools/view/overlay.h"

namespace rung::rungc {

// The program is read again from its files. `project`: the title; empty: the files are. Fails when a file cannot be
// read, or the program has errors now.
Result<std::string> pageWith(const view::Overlay& overlay, const std::vector<std::string>& files,
                             const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                             const std::string& project);

} // namespace rung::rungc
