// Compiles a program for what its drawing says of names and uses (see drawn_program.h).
#include "tools/view/drawn_program.h"

#include "frontend/dialects/gsk/gsk.h"
#include "ir/layout/program_image.h"

namespace rung::view {
namespace {

std::optional<gsk::LadderForm> laddersOf(const frontend::Dialect& dialect, SourceManager& sources,
                                         std::span<const FileId> files, const frontend::CompileOptions& options,
                                         Diagnostics& diagnostics) {
  if (&dialect == &gsk::kGsk) return gsk::ladderForm(sources, files, options, diagnostics);
  return gsk::LadderForm{{files.begin(), files.end()}, {}, {}};
}

} // namespace

bool hasDrawing(const frontend::Dialect& dialect) { return dialect.findBox != nullptr; }

std::optional<Program> drawnProgram(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                    Diagnostics& diagnostics) {
  const auto module = dialect.compile(sources, files, options, diagnostics);
  if (module == nullptr) return std::nullopt;
  const auto ladders = laddersOf(dialect, sources, files, options, diagnostics);
  if (!ladders) return std::nullopt;
  Diagnostics unheard; // the same program: reported already
  const auto drawn = dialect.check(sources, ladders->files, options, unheard);
  const ir::Layout layout(*module, {});
  const ir::ProgramImage image(layout, 0);
  const ir::Uses uses(*module);
  const xref::CrossReference reference(image.program(), uses, dialect.shownSpaces);
  return readProgram(sources, {.dialect = &dialect,
                               .files = ladders->files,
                               .analysis = &drawn->analysis(),
                               .reference = &reference,
                               .messages = module->messages,
                               .origins = {ladders->networks, ladders->elements},
                               .authors = {files.begin(), files.end()}});
}

} // namespace rung::view
