// Compiles a program for what its drawing says of names and uses (see drawn_program.h).
#include "tools/view/drawn_program.h"

#include <algorithm>

#include "frontend/dialects/gsk/gsk.h"
#include "frontend/dialects/gsk/language.h"
#include "tools/report/cross_reference.h"

namespace rung::view {
namespace {

std::optional<frontend::network::LadderForm> laddersOf(const frontend::Dialect& dialect, SourceManager& sources,
                                                       std::span<const FileId> files, Diagnostics& diagnostics) {
  if (&dialect == &frontend::gsk::kGsk)
    return frontend::network::ladderForm(frontend::gsk::kLanguage, sources, files, diagnostics);
  return frontend::network::LadderForm{{files.begin(), files.end()}, {}, {}};
}

} // namespace

bool hasDrawing(const frontend::Dialect& dialect) { return dialect.findBox != nullptr; }

std::optional<Program> drawnProgram(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                    Diagnostics& diagnostics) {
  const size_t before = diagnostics.errorCount();
  auto program = dialect.check(sources, files, options, diagnostics);
  const auto module = diagnostics.errorCount() == before ? program->build() : nullptr;
  if (module == nullptr) return std::nullopt;
  const auto ladders = laddersOf(dialect, sources, files, diagnostics);
  if (!ladders) return std::nullopt;
  Diagnostics discarded; // the same program: all of it has been reported
  if (!std::ranges::equal(ladders->files, files)) program = dialect.check(sources, ladders->files, options, discarded);
  const report::ModuleReference reference(*module, dialect.shownSpaces);
  return readProgram(sources, {.dialect = &dialect,
                               .files = ladders->files,
                               .analysis = &program->analysis(),
                               .reference = &reference.get(),
                               .messages = module->messages,
                               .origins = {ladders->networks, ladders->elements},
                               .authors = {files.begin(), files.end()}});
}

std::optional<Listing> listedProgram(SourceManager& sources, std::span<const FileId> files,
                                     const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                     Diagnostics& diagnostics) {
  const auto module = dialect.compile(sources, files, options, diagnostics);
  if (module == nullptr) return std::nullopt;
  const std::vector<std::string> included =
      dialect.included == nullptr ? std::vector<std::string>() : dialect.included(sources, files, options);
  return listingOf(sources, files, dialect.title, rowsOf(*module), included);
}

} // namespace rung::view
