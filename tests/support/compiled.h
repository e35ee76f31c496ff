// Compiles texts of a dialect in a test.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "ir/support/diag_render.h"

namespace rung::frontend::test {

struct Compiled {
  SourceManager sources;
  Diagnostics diagnostics;
  std::unique_ptr<ir::Module> module;

  // "LINE CODE" of every report, in the order of the lines; "-" in place of the line where a report has none.
  std::vector<std::string> codes() const {
    std::vector<std::string> result;
    for (const Diagnostic* d : diagnostics.sorted()) {
      const std::string line = d->range.valid() ? std::to_string(sources.lineCol(d->range.begin).line) : "-";
      result.push_back(line + " " + std::string(diagInfo(d->id).code));
    }
    return result;
  }
  std::string text() const { return renderText(diagnostics, sources); }
};

struct File {
  std::string name;
  std::string text;
};

inline std::unique_ptr<Compiled> compileFiles(const Dialect& dialect, const std::vector<File>& texts,
                                              const CompileOptions& options = {}) {
  auto result = std::make_unique<Compiled>();
  std::vector<FileId> files;
  for (const File& file : texts) files.push_back(result->sources.addBuffer(file.name, file.text));
  result->module = dialect.compile(result->sources, files, options, result->diagnostics);
  return result;
}

using Codes = std::vector<std::string>;

// In one text: hundreds of lists to compare with cost the compiler more than the whole rest of a test.
inline std::string listed(const Codes& codes) {
  std::string text;
  for (const std::string& code : codes) text += (text.empty() ? "" : ", ") + code;
  return text;
}

} // namespace rung::frontend::test
