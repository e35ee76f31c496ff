// See compiled_program.h.
#include "tests/support/compiled_program.h"

#include "ir/support/check.h"
#include "ir/support/diag_render.h"

namespace rung::testing {

CompiledProgram::CompiledProgram(const std::string& file, const std::string& text, compiler::EngineKind engine) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId id = sources.addBuffer(file, text);
  std::optional<compiler::Compiled> compiled = compiler::compile(sources, {&id, 1}, {}, diagnostics);
  RUNG_CHECK(compiled.has_value(), renderText(diagnostics, sources).c_str());
  compiled_ = std::move(*compiled);
  auto made = compiler::makeEngine(engine, compiled_, {});
  RUNG_CHECK(made.ok(), made.error().c_str());
  engine_ = std::move(made.value());
}

} // namespace rung::testing
