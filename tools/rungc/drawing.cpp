// Programs as they are drawn (see drawing.h).
#include "tools/rungc/drawing.h"

#include "frontend/dialects/gsk/convert/convert.h"
#include "frontend/dialects/gsk/gsk.h"
#include "frontend/dialects/nct/nct.h"

namespace rung::rungc {
namespace {

std::optional<gsk::LadderForm> laddersOf(const frontend::Dialect& dialect, SourceManager& sources,
                                         std::span<const FileId> files, const frontend::CompileOptions& options,
                                         Diagnostics& diagnostics) {
  if (&dialect == &gsk::kGsk) return gsk::ladderForm(sources, files, options, diagnostics);
  return gsk::LadderForm{{files.begin(), files.end()}, {}, {}};
}

} // namespace

bool hasDrawing(const frontend::Dialect& dialect) { return &dialect == &gsk::kGsk || &dialect == &nct::kNct; }

std::optional<view::Program> drawingOf(SourceManager& sources, std::span<const FileId> files,
                                       const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                       Diagnostics& diagnostics) {
  const auto module = dialect.compile(sources, files, options, diagnostics);
  if (module == nullptr || diagnostics.hasErrors()) return std::nullopt;
  const auto ladders = laddersOf(dialect, sources, files, options, diagnostics);
  if (!ladders) return std::nullopt;
  return view::readProgram(
      sources,
      {&dialect, module.get(), ladders->files, {ladders->networks, ladders->elements}, {files.begin(), files.end()}});
}

} // namespace rung::rungc
