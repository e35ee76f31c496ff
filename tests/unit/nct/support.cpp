// See support.h.
#include "tests/unit/nct/support.h"

#include <fmt/format.h>

#include "frontend/dialects/nct/nct.h"
#include "ir/support/diag_render.h"

namespace rung::frontend::nct::test {

std::vector<std::string> Compiled::codes() const {
  std::vector<std::string> codes;
  for (const Diagnostic* d : diagnostics.sorted()) {
    std::string place = "0:0";
    if (d->range.valid()) {
      const LineCol at = sources.lineCol(d->range.begin);
      place = fmt::format("{}:{}", at.line, at.column);
    }
    codes.push_back(
        fmt::format("{} {}{}", place, diagInfo(d->id).code, d->severity == Severity::Warning ? " (w)" : ""));
  }
  return codes;
}

std::string Compiled::rendered() const { return renderText(diagnostics, sources); }

Compiled compileFile(std::string text, const Options& options) {
  Compiled result;
  const FileId file = result.sources.addBuffer("test.lad", std::move(text));
  result.module = kNct.compile(result.sources, {&file, 1}, options, result.diagnostics);
  return result;
}

Compiled compileMain(std::string_view body, const Options& options) {
  return compileFile("dialect nct\nmodule MAIN\n" + std::string(body), options);
}

} // namespace rung::frontend::nct::test
