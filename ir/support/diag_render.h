// Diagnostics as text for a terminal and as JSON for tools.
#pragma once

#include <cstddef>
#include <string>

#include "ir/support/diagnostics.h"

namespace rung {

/// Commands whose purpose is not to check show no warnings if there are more than these.
inline constexpr size_t kMostWarnings = 10;

struct RenderOptions {
  bool color = false;
  /// Source lines are shortened to about this many characters around the error.
  size_t width = 100;
  /// Otherwise only errors.
  bool warnings = true;
};

/// For each diagnostic "file:line:column: error: message [code]", the source line with the range underlined, labels,
/// notes and fixes; at the end the number of dropped diagnostics, if any.
std::string renderText(const Diagnostics& diagnostics, const SourceManager& sources, RenderOptions options = {});

/// "2 errors, 1 warning; try `rungc explain CODE`", as a line; "" if there are no errors.
std::string closingLine(const Diagnostics& diagnostics);

/// One array of objects with code, severity, message, file, line, column, endLine, endColumn, labels, notes, fixes. A
/// diagnostic without a position has file "" and zeros.
std::string renderJson(const Diagnostics& diagnostics, const SourceManager& sources);

} // namespace rung
