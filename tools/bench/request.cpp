// See request.h.
#include "tools/bench/request.h"

#include <optional>

#include "compiler/project.h"
#include "ir/support/diag_render.h"

namespace rung::bench {

compiler::CompileRequest requestOf(SourceManager& sources, const std::vector<std::string>& paths,
                                   std::vector<FileId>& files) {
  compiler::CompileRequest request;
  const std::string& path = paths[0];
  if (!path.ends_with(compiler::kFileName)) {
    files = good(compiler::addFiles(sources, paths, {}));
    return request;
  }
  Diagnostics diagnostics;
  const std::optional<compiler::Project> project = compiler::load(sources, path, diagnostics);
  if (!project) throw std::runtime_error(renderText(diagnostics, sources));
  request.dialect = project->dialect;
  request.options.includePaths = project->includePaths;
  for (const compiler::Setting& setting : project->config) request.options.config[setting.key] = setting.value;
  files = good(compiler::addFiles(sources, project->files, request.options.config));
  return request;
}

} // namespace rung::bench
