// What the fuzz targets of formatters share: any bytes as a program of one or several files. What is laid out stays as
// it is when that is done again, and is the same program.
#pragma once
#include <cstdio>
#include <string>
#include <string_view>

#include "ir/support/check.h"
#include "tests/fuzz/split_files.h"
#include "tests/support/formatting.h"

namespace rung::fuzz {

inline std::optional<std::string> formatText(const frontend::Dialect& dialect, const std::string& name,
                                             const std::string& text) {
  SourceManager sources;
  Diagnostics diagnostics;
  auto formatted = dialect.format(sources, sources.addBuffer(name, text), diagnostics);
  RUNG_CHECK(formatted.has_value() != diagnostics.hasErrors(), "no text without a reason");
  return formatted;
}

// `border`: the byte that begins the next file. `extension`: of the files' names, with its dot.
inline void formatBytes(const frontend::Dialect& dialect, std::string_view extension, char border,
                        const std::string& text) {
  if (text.find("\r\r") != std::string::npos) return; // what is one too many goes, though it could be part of a title
  SourceManager sources, formattedSources;
  std::vector<FileId> files, formattedFiles;
  for (const auto& [name, original] : splitFiles(text, extension, border)) {
    const auto formatted = formatText(dialect, name, original);
    if (!formatted) return;
    RUNG_CHECK(formatText(dialect, name, *formatted) == formatted, "what is laid out is laid out");
    const auto lines = test::onItsLines(*formatted, original);
    RUNG_CHECK(lines.has_value(), "a line stays a line");
    files.push_back(sources.addBuffer(name, original));
    formattedFiles.push_back(formattedSources.addBuffer(name, *lines));
  }
  const test::Meaning meaning = test::meaningOf(dialect, sources, files, {});
  test::Meaning formatted = test::meaningOf(dialect, formattedSources, formattedFiles, {});
  if (meaning.module.empty())
    formatted.reported = meaning.reported; // of a mistake a column may decide what it is called
  if (formatted != meaning) std::fputs(test::differenceOf(meaning, formatted).c_str(), stderr);
  RUNG_CHECK(formatted == meaning, "it is the same program");
}

} // namespace rung::fuzz
