// See opened_program.h.
#include "tools/rungc/opened_program.h"

#include "compiler/engines.h"

namespace rung::rungc {

std::optional<OpenedProgram> openProgram(const SourceOptions& source, int& status) {
  OpenedProgram program;
  if (source.files.size() == 1 && source.files[0].ends_with(".so")) {
    const rung_image_options options{.size = sizeof options, .allow_unsealed = 0, .keys_folder = nullptr};
    try {
      program.image = std::make_unique<Image>(source.files[0], &options);
    } catch (const Error& error) {
      status = environmentError(error.what());
      return std::nullopt;
    }
    return program;
  }
  SourceManager sources;
  program.compiled = compileSources(sources, source, {}, status);
  if (!program.compiled) return std::nullopt;
  Result<std::unique_ptr<runtime::Engine>> engine =
      compiler::makeEngine(compiler::EngineKind::Interp, *program.compiled, {});
  if (!engine.ok()) {
    status = environmentError(engine.error());
    return std::nullopt;
  }
  program.engine = std::move(engine).value();
  rung_image* image = nullptr;
  check(rung_image_adopt(&program.engine->program(), program.engine->context(), nullptr, nullptr, &image));
  program.image = std::make_unique<Image>(image);
  return program;
}

} // namespace rung::rungc
