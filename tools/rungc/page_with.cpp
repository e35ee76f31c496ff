// See page_with.h.
#include "tools/rungc/page_with.h"

#include <fmt/format.h>

#include "compiler/compile.h"
#include "tools/view/drawn_program.h"
#include "tools/view/html.h"

namespace rung::rungc {

Result<std::string> pageWith(const view::Overlay& overlay, const std::vector<std::string>& files,
                             const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                             const std::string& project) {
  SourceManager sources;
  const Result<std::vector<FileId>> ids = compiler::addFiles(sources, files, options.config);
  if (!ids.ok()) return ids.failure();
  const std::string changed = fmt::format("{} was changed while its scenarios ran", files.front());
  Diagnostics diagnostics;
  if (!view::hasDrawing(dialect)) {
    auto listing = view::listedProgram(sources, ids.value(), dialect, options, diagnostics);
    if (!listing) return failure(changed);
    if (!project.empty()) listing->title = project;
    return view::renderTable(*listing, overlay);
  }
  auto drawing = view::drawnProgram(sources, ids.value(), dialect, options, diagnostics);
  if (!drawing) return failure(changed);
  if (!project.empty()) drawing->title = project;
  view::lay(overlay, *drawing);
  return view::renderHtml(*drawing);
}

} // namespace rung::rungc
