// Diagnostics as text for people and as JSON for tools.
#pragma once

#include <string>

#include "ir/support/diagnostics.h"

namespace rung {

struct RenderOptions {
  bool color = false;
  /// Source lines are cut to about this many characters around the place of the error.
  size_t width = 100;
};

/// For each diagnostic "file:line:column: error: message [code]", the source line with the place underlined, labels,
/// notes and fixes; at the end how many were left out, if any.
std::string renderText(const Diagnostics& diagnostics, const SourceManager& sources, RenderOptions options = {});

/// "2 errors, 1 warning; try `rungc explain CODE`", a line; "" without an error.
std::string closingLine(const Diagnostics& diagnostics);

/// One array of objects with code, severity, message, file, line, column, endLine, endColumn, labels, notes, fixes. A
/// diagnostic without a place has file "" and zeros.
std::string renderJson(const Diagnostics& diagnostics, const SourceManager& sources);

} // namespace rung
