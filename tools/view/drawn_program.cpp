// Compiles a program for the names and uses in its drawing (see drawn_program.h).
#include "tools/view/drawn_program.h"

#include <algorithm>
#include <map>

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

bool hasDrawing(const frontend::Dialect& dialect) { return dialect.findBox != nullptr; }

std::optional<Program> drawnProgram(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::Dialect& dialect, const frontend::CompileOptions& options,
                                    Diagnostics& diagnostics) {
  const size_t before = diagnostics.errorCount();
  auto program = dialect.check(sources, files, options, diagnostics);
  const auto module = diagnostics.errorCount() == before ? program->build() : nullptr;
  if (module == nullptr) return std::nullopt;
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

std::vector<TableRow> rowsOf(const ir::Module& module) {
  std::map<uint32_t, TableRow> rows; // by the rung's number over all routines, which is in source order
  uint32_t index = 0;
  for (const ir::Routine& routine : module.routines) {
    for (const ir::Rung& rung : routine.rungs) {
      const uint32_t at = rung.origin.index == RUNG_NONE ? index : rung.origin.index;
      ++index;
      if (rung.number == 0) continue;
      const bool known = rung.begin.line > 0;
      rows[at] = {rung.number,
                  ir::homeOf(routine, rung),
                  rung.title,
                  {known ? module.files[rung.begin.file.index] : "", rung.begin.line, 0},
                  rung.lastLine};
    }
  }
  std::vector<TableRow> list;
  for (auto& [at, row] : rows) list.push_back(std::move(row));
  return list;
}

Listing listingOf(const SourceManager& sources, std::span<const FileId> files, std::string_view control,
                  std::vector<TableRow> rows, const std::vector<std::string>& included) {
  std::vector<std::string> names;
  for (const FileId file : files) names.emplace_back(sources.name(file));
  Listing listing{titleOf(shownFiles(names)), std::string(control), std::move(rows), {}};
  // In source order, whatever the order of routines; several rungs of the module that are one rung of the source become
  // one row.
  std::ranges::stable_sort(listing.rows, {}, &TableRow::number);
  const auto again = std::ranges::unique(listing.rows, {}, &TableRow::number);
  listing.rows.erase(again.begin(), again.end());
  std::map<std::string_view, FileId> readable; // the last one of a name: its text after the dialect has decoded it
  for (uint32_t i = 0; i < sources.fileCount(); ++i) readable[sources.name(FileId{i})] = FileId{i};
  const auto add = [&](const std::string& path) {
    const auto file = readable.find(path);
    const auto [text, isNew] = listing.texts.try_emplace(path);
    if (!isNew || file == readable.end()) return;
    frontend::LineReader lines(sources, file->second);
    for (frontend::SourceLine line; lines.next(line);) text->second.emplace_back(line.text);
  };
  for (const TableRow& row : listing.rows) add(row.place.file);
  std::ranges::for_each(names, add);
  std::ranges::for_each(included, add);
  std::erase_if(listing.texts, [](const auto& text) { return text.second.empty(); });
  return listing;
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
