// Compiles a program for the names and uses in its drawing (see drawn_program.h).
#include "tools/view/drawn_program.h"

#include <utility>

#include "frontend/syntax/word_lexer.h"
#include "tools/report/cross_reference.h"

namespace rung::view {
namespace {

// The program as ladder text.
std::optional<frontend::network::LadderForm> laddersOf(const std::optional<frontend::NetworkSource>& networks,
                                                       SourceManager& sources, std::span<const FileId> files,
                                                       Diagnostics& diagnostics) {
  if (networks) return frontend::network::ladderForm(networks->language, sources, files, diagnostics);
  return frontend::network::LadderForm{{files.begin(), files.end()}, {}, {}};
}

} // namespace

std::optional<Program> drawnProgram(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                    Diagnostics& diagnostics) {
  const size_t before = diagnostics.errorCount();
  auto program = dialect.check(sources, files, options, diagnostics);
  const auto module = diagnostics.errorCount() == before ? program->build() : nullptr;
  if (module == nullptr) return std::nullopt;
  if (auto charts = program->charts(*module)) {
    const report::ModuleReference reference(*module, dialect.shownSpaces);
    const Input input{
        .dialect = &dialect, .analysis = &program->analysis(), .reference = &reference.get(), .authors = charts->files};
    return readCharts(sources, input, std::move(*charts));
  }
  const auto networks = program->networks();
  const std::vector<FileId> written(networks ? networks->files.begin() : files.begin(),
                                    networks ? networks->files.end() : files.end());
  const auto ladders = laddersOf(networks, sources, written, diagnostics);
  if (!ladders) return std::nullopt;
  Diagnostics discarded; // the same program: everything has been reported
  if (ladders->files != written) program = dialect.check(sources, ladders->files, options, discarded);
  const report::ModuleReference reference(*module, dialect.shownSpaces);
  return readProgram(sources, {.dialect = &dialect,
                               .language = networks ? &networks->language : nullptr,
                               .files = ladders->files,
                               .analysis = &program->analysis(),
                               .reference = &reference.get(),
                               .messages = module->messages,
                               .origins = {ladders->networks, ladders->elements},
                               .authors = written});
}

} // namespace rung::view
