// What tests of formatters share: a program and its formatted text are the same program.
#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "frontend/syntax/page.h"
#include "ir/support/utf8.h"
#include "ir/text/text.h"

namespace rung::test {

// A text without byte order mark and end mark, by lines without line ends and space after them.
inline std::vector<std::string_view> linesOf(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.ends_with('\x1A')) text.remove_suffix(1);
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    lines.push_back(frontend::withoutTrailingSpace(text.substr(0, end)));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

// `formatted` with the blank lines of `original`, so that everything is on the line that it was on. Nothing where a
// line that is not blank is missing or new.
inline std::optional<std::string> onItsLines(std::string_view formatted, std::string_view original) {
  std::vector<std::string_view> rest = linesOf(formatted);
  std::erase(rest, std::string_view());
  std::string text;
  size_t next = 0;
  for (const std::string_view line : linesOf(original)) {
    const bool blank = line.find_first_not_of(" \t\f") == std::string_view::npos;
    if (!blank && next == rest.size()) return std::nullopt;
    text.append(blank ? std::string_view() : rest[next++]).append("\n");
  }
  return next == rest.size() ? std::optional(text) : std::nullopt;
}

// What a compilation gives, but for columns and the texts of rungs.
struct Meaning {
  std::vector<std::string> reported; // FILE:LINE code
  std::string module;                // "" where there is none
  bool operator==(const Meaning&) const = default;
};

inline Meaning meaningOf(const frontend::Dialect& dialect, SourceManager& sources, std::span<const FileId> files,
                         const frontend::CompileOptions& options) {
  Diagnostics diagnostics;
  const auto module = dialect.compile(sources, files, options, diagnostics);
  Meaning meaning;
  for (const Diagnostic& one : diagnostics.reported()) {
    const LineCol at = one.range.valid() ? sources.lineCol(one.range.begin) : LineCol{};
    meaning.reported.push_back(std::string(at.file).append(":") + std::to_string(at.line) + " " +
                               std::string(diagInfo(one.id).code));
  }
  std::ranges::sort(meaning.reported);
  if (module == nullptr) return meaning;
  for (ir::Routine& routine : module->routines)
    for (ir::Rung& rung : routine.rungs) {
      rung.begin.column = 0;
      rung.key = 0;
      rung.sourceText.clear();
    }
  meaning.module = ir::print(*module);
  return meaning;
}

// For people: the first line in which two of them differ, or what is reported.
inline std::string differenceOf(const Meaning& one, const Meaning& other) {
  const auto joined = [](const Meaning& meaning) {
    std::string text;
    for (const std::string& reported : meaning.reported) text.append(reported).append("\n");
    return text + meaning.module;
  };
  const std::string a = joined(one), b = joined(other);
  const size_t at = static_cast<size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
  const size_t line = a.rfind('\n', at) + 1;
  return a.substr(line, a.find('\n', at) - line) + "\n" + b.substr(line, b.find('\n', std::min(at, b.size())) - line) +
         "\n";
}

} // namespace rung::test
