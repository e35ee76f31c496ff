// Numbered lines (see listing.h).
#include "frontend/dialects/technol/listing.h"

#include <fmt/format.h>
#include <iterator>

namespace rung::frontend::technol {

std::string listing(const SourceManager& sources, std::span<const FileId> files) {
  std::string out;
  const auto put = std::back_inserter(out);
  for (const FileId file : files) {
    if (!out.empty()) out += '\n';
    fmt::format_to(put, "; {}\n", sources.name(file));
    const uint32_t lines = sources.lineCount(file);
    for (uint32_t line = 1; line <= lines; ++line) {
      const std::string_view text = sources.lineText(file, line);
      if (line == lines && text.empty()) break; // behind the last line end
      fmt::format_to(put, "{:6}{}{}\n", line, text.empty() ? "" : "  ", text);
    }
  }
  return out;
}

} // namespace rung::frontend::technol
