// See drawn_sources.h.
#include "tools/rungc/drawn_sources.h"

#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <optional>
#include <utility>

#include "ir/support/diag_render.h"
#include "machine/compile/source_paths.h"
#include "rtlib/nc/config_key.h"
#include "tools/rungc/commands.h"
#include "tools/view/drawn_program.h"

namespace rung::rungc {
namespace {

// The sources of a program, read.
struct Sources {
  SourceManager texts;
  std::vector<FileId> files;
  compiler::CompileRequest request;
};

// The project that the files belong to has its own settings. "" or why they cannot be read.
std::string read(const std::vector<std::string>& files, const compiler::Compiled& program, Sources& to) {
  SourceOptions options;
  options.files = files;
  options.quiet = true;
  int status = takeProject(options);
  if (status != kOk) return fmt::format("the project of {} cannot be read", fmt::join(files, ", "));
  to.request.dialect = options.dialect;
  to.request.name = options.project ? options.project->name : "";
  to.request.instrument = program.passes.instrument;
  to.request.optimise = program.passes.optimise;
  for (const std::string& file : options.files)
    if (std::error_code none; !std::filesystem::exists(file, none)) return fmt::format("there is no file {}", file);
  auto added = addSources(to.texts, options, to.request.options, status);
  if (!added) return fmt::format("{} cannot be read", fmt::join(options.files, ", "));
  to.request.options.configPlaces.clear(); // a drawing shows no mistakes
  to.files = std::move(*added);
  return {};
}

// The hash of what they are compiled to; or their mistakes.
Result<uint64_t> hashOf(Sources& sources) {
  Diagnostics diagnostics;
  const auto compiled = compiler::compile(sources.texts, sources.files, sources.request, diagnostics);
  if (!compiled || diagnostics.hasErrors()) return failure(renderText(diagnostics, sources.texts));
  return compiled->codeHash;
}

// The same texts under the paths that they have in the program.
Sources renamed(const Sources& from, const compiler::Compiled& program) {
  std::vector<std::string> here;
  for (const FileId file : from.files) here.emplace_back(from.texts.name(file));
  const compile::SourcePaths paths(program.module->files, here);
  std::map<std::string, std::string> texts;
  for (uint32_t file = 0; file < from.texts.fileCount(); ++file)
    texts.emplace(paths.ofProgram(std::string(from.texts.name(FileId{file}))), from.texts.text(FileId{file}));
  Sources to{SourceManager(texts), {}, from.request};
  for (const std::string& file : here) to.files.push_back(to.texts.addFile(paths.ofProgram(file)).value());
  frontend::CompileOptions& options = to.request.options;
  for (std::string& folder : options.includePaths) folder = paths.ofProgram(folder);
  for (auto& [key, value] : options.config)
    if (texts.contains(paths.ofProgram(value))) value = paths.ofProgram(value);
  options.config.erase(std::string(nc::kEncodingKey.key)); // these texts are in UTF-8
  return to;
}

Result<web::ShownProgram> drawn(Sources& sources, const frontend::Dialect& dialect) {
  Diagnostics diagnostics;
  auto drawing = view::drawnProgram(sources.texts, sources.files, dialect, sources.request.options, diagnostics);
  if (!drawing) return failure(renderText(diagnostics, sources.texts));
  if (!sources.request.name.empty()) drawing->title = sources.request.name;
  return web::ShownProgram(std::move(*drawing));
}

} // namespace

Result<web::ShownProgram> drawnAgain(const compiler::Compiled& compiled, const std::string& title) {
  Sources sources;
  sources.request.name = title;
  Result<std::vector<FileId>> files =
      compiler::addFiles(sources.texts, compiled.module->files, compiled.options.config);
  if (!files.ok()) return files.failure();
  sources.files = std::move(files).value();
  sources.request.options = compiled.options;
  sources.request.options.configPlaces.clear(); // they are positions in the sources of the first compilation
  Result<web::ShownProgram> shown = drawn(sources, *compiled.dialect);
  if (!shown.ok()) return failure(fmt::format("{} was changed while it was compiled", compiled.module->files.front()));
  return shown;
}

Result<web::ShownProgram> drawnFrom(const compiler::Compiled& program, const std::vector<std::string>& files) {
  const bool areNamed = !files.empty();
  const std::string which = fmt::format("{}", fmt::join(areNamed ? files : program.module->files, ", "));
  const std::string how = areNamed ? "name the sources from which it was built"
                                   : "name its sources as they are here, or the folder of its project";
  Sources sources;
  if (const std::string problem = read(areNamed ? files : program.module->files, program, sources); !problem.empty())
    return failure(fmt::format("the program {} cannot be drawn: {}; {}", program.module->name, problem, how));
  Result<uint64_t> hash = hashOf(sources);
  if (hash.ok() && hash.value() == program.codeHash) return drawn(sources, *program.dialect);
  Sources there = renamed(sources, program);
  hash = hashOf(there);
  if (hash.ok() && hash.value() == program.codeHash) return drawn(there, *program.dialect);
  if (!hash.ok()) return failure(fmt::format("the program {} cannot be drawn: {}", program.module->name, hash.error()));
  return failure(fmt::format("the program {} cannot be drawn: {} {} changed since it was built (`rungctl verify` lists "
                             "the rungs that differ); {}",
                             program.module->name, which,
                             (areNamed ? files : program.module->files).size() == 1 ? "was" : "were", how));
}

} // namespace rung::rungc
