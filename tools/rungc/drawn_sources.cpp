// See drawn_sources.h.
#include "tools/rungc/drawn_sources.h"

#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <utility>

#include "compiler/project.h"
#include "ir/support/diag_render.h"
#include "machine/compile/source_paths.h"
#include "machine/rung-compile/collect.h"
#include "tools/view/drawn_program.h"

namespace rung::rungc {
namespace {

// What a program is compiled and drawn from.
struct Texts {
  SourceManager sources;
  std::vector<FileId> files;
  compiler::CompileRequest request;
  std::string title; // of the drawing; "": the names of the files
};

Texts textsOf(const compile::Sources& from, const compiler::Compiled& program) {
  Texts texts{SourceManager(from.texts), {}, {}, from.name};
  for (const std::string& file : from.files) texts.files.push_back(texts.sources.addFile(file).value());
  texts.request.dialect = from.dialect;
  texts.request.name = program.module->name; // the project's, or that of the folder it was built in
  texts.request.options.config = from.config;
  texts.request.options.includePaths = from.includePaths;
  texts.request.instrument = program.passes.instrument;
  texts.request.optimise = program.passes.optimise;
  return texts;
}

// Whether they are those of the program; the error is what is wrong with them.
Result<bool> isOf(Texts& texts, const compiler::Compiled& program) {
  Diagnostics diagnostics;
  const auto compiled = compiler::compile(texts.sources, texts.files, texts.request, diagnostics);
  if (!compiled || diagnostics.hasErrors()) return failure(renderText(diagnostics, texts.sources));
  return compiled->codeHash == program.codeHash;
}

Result<web::ShownProgram> drawn(Texts& texts, const frontend::Dialect& dialect) {
  Diagnostics diagnostics;
  auto drawing = view::drawnProgram(texts.sources, texts.files, dialect, texts.request.options, diagnostics);
  if (!drawing) return failure(renderText(diagnostics, texts.sources));
  if (!texts.title.empty()) drawing->title = texts.title;
  return web::ShownProgram(std::move(*drawing));
}

} // namespace

Result<web::ShownProgram> drawnAgain(const compiler::Compiled& compiled, const std::string& title) {
  Texts texts;
  Result<std::vector<FileId>> files =
      compiler::addFiles(texts.sources, compiled.module->files, compiled.options.config);
  if (!files.ok()) return files.failure();
  texts.files = std::move(files).value();
  texts.title = title;
  texts.request.options = compiled.options;
  texts.request.options.configPlaces.clear(); // they are positions in the sources of the first compilation
  Result<web::ShownProgram> shown = drawn(texts, *compiled.dialect);
  if (!shown.ok()) return failure(fmt::format("{} was changed while it was compiled", compiled.module->files.front()));
  return shown;
}

namespace {

// Drawn from these files, if the program was built from them: as they are called here, or there. Nothing: it was not.
std::optional<Result<web::ShownProgram>> drawnIfOf(const compiler::Compiled& program,
                                                   const std::vector<std::string>& files, std::string& why) {
  rung_compile::Collected collected = rung_compile::collect(files);
  if (!collected.sources) {
    why = collected.report;
    return std::nullopt;
  }
  for (const bool renamed : {false, true}) {
    if (renamed) {
      const std::vector<std::string> here = collected.sources->files;
      compile::rename(*collected.sources, compile::SourcePaths(program.module->files, here));
      if (collected.sources->files == here) break;
    }
    Texts texts = textsOf(*collected.sources, program);
    const Result<bool> same = isOf(texts, program);
    if (same.ok() && same.value()) return drawn(texts, *program.dialect);
    why = same.ok() ? "" : same.error();
  }
  return std::nullopt;
}

} // namespace

Result<web::ShownProgram> drawnFrom(const compiler::Compiled& program, const std::vector<std::string>& files) {
  const std::vector<std::string>& own = program.module->files;
  std::vector<std::vector<std::string>> choices = {files.empty() ? own : files};
  if (files.empty()) // their project has their configuration
    if (const auto project = compiler::findUpwards(std::filesystem::path(own.front()).parent_path().string()))
      choices.insert(choices.begin(), {*project});
  std::string why;
  for (const std::vector<std::string>& choice : choices)
    if (auto shown = drawnIfOf(program, choice, why)) return std::move(*shown);
  if (why.empty())
    why =
        fmt::format("it was built from another version of {}, or with other settings", fmt::join(choices.back(), ", "));
  return failure(fmt::format("the program {} cannot be drawn: {}{}", program.module->name, why,
                             files.empty() ? "; name its sources as they are here, or their project" : ""));
}

} // namespace rung::rungc
