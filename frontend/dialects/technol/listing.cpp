// Numbered lines (see listing.h).
#include "frontend/dialects/technol/listing.h"

#include <fmt/format.h>
#include <map>
#include <utility>

#include "ir/support/put.h"

namespace rung::frontend::technol {

namespace {

using LineOfFile = std::pair<std::string_view, uint32_t>;

std::map<LineOfFile, uint32_t> rungNumbers(const ir::Module& module) {
  std::map<LineOfFile, uint32_t> numbers;
  for (const ir::Routine& routine : module.routines)
    for (const ir::Rung& rung : routine.rungs)
      if (rung.number != 0)
        numbers.emplace(LineOfFile(module.files[rung.begin.file.index], rung.begin.line), rung.number);
  return numbers;
}

} // namespace

std::string listing(const SourceManager& sources, std::span<const FileId> files, const ir::Module& module) {
  const std::map<LineOfFile, uint32_t> numbers = rungNumbers(module);
  std::string out;
  for (const FileId file : files) {
    if (!out.empty()) out += '\n';
    put(out, "; {}\n; line rung\n", sources.name(file));
    const uint32_t lines = sources.lineCount(file);
    for (uint32_t line = 1; line <= lines; ++line) {
      const std::string_view text = sources.lineText(file, line);
      if (line == lines && text.empty()) break; // after the last line end
      const auto number = numbers.find({sources.name(file), line});
      const std::string rung = number == numbers.end() ? "" : std::to_string(number->second);
      if (text.empty())
        put(out, "{:6}\n", line);
      else
        put(out, "{:6} {:>5}  {}\n", line, rung, text);
    }
  }
  return out;
}

} // namespace rung::frontend::technol
