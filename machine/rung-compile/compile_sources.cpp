// See compile_sources.h.
#include "machine/rung-compile/compile_sources.h"

#include <fmt/format.h>
#include <vector>

#include "codegen/llvm/llvm_emitter.h"
#include "compiler/compile.h"
#include "compiler/configuration.h"
#include "compiler/embedded_ir.h"
#include "ir/support/diag_render.h"
#include "machine/compile/sources.h"
#include "rtlib/load/seal.h"

namespace rung::rung_compile {
namespace {

compiler::CompileRequest requestOf(const compile::Sources& sources) {
  compiler::CompileRequest request;
  request.dialect = sources.dialect;
  request.name = sources.name;
  request.options.config = sources.config;
  request.options.includePaths = sources.includePaths;
  request.instrument = sources.profile;
  request.marks = request.keepBuilt = true; // of its recordings, contacts and coils are shown
  return request;
}

// The same checks as in `rungc build`.
void checkNames(const compiler::Compiled& compiled, const SourceManager& sources, Diagnostics& diagnostics) {
  const std::vector<std::pair<std::string, std::string>> pairs(compiled.options.config.begin(),
                                                               compiled.options.config.end());
  for (const compiler::ConfigProblem& problem : compiler::checkNamesOfProgram(*compiled.dialect, sources, pairs))
    compiler::report(problem, *compiled.dialect, {}, diagnostics);
}

std::string reportOf(const Diagnostics& diagnostics, const SourceManager& sources) {
  const bool showsWarnings = diagnostics.warningCount() <= kMostWarnings;
  std::string report = renderText(diagnostics, sources, {.warnings = showsWarnings});
  if (!showsWarnings) report += fmt::format("more than {} warnings: `rungc check` shows all\n", kMostWarnings);
  report += closingLine(diagnostics);
  constexpr std::string_view kCut = "\n(more has been left out)\n";
  if (report.size() <= compile::kMostReport - kCut.size()) return report;
  report.resize(compile::kMostReport - kCut.size());
  return report.append(kCut);
}

Outcome compile(const compile::Sources& given) {
  SourceManager sources(given.texts);
  std::vector<FileId> files;
  for (const std::string& name : given.files) files.push_back(sources.addFile(name).value());
  Diagnostics diagnostics;
  const auto compiled = compiler::compile(sources, files, requestOf(given), diagnostics);
  if (compiled) checkNames(*compiled, sources, diagnostics);
  std::string report = reportOf(diagnostics, sources);
  if (!compiled || diagnostics.hasErrors())
    return {.verdict = compile::kVerdictErrors, .report = std::move(report), .image = {}};
  codegen::LlvmOptions options;
  options.debugInfo = false;
  Result<std::string> object = codegen::buildLlvmSharedObjectByOutput(*compiled->layout, compiled->codeHash, options);
  if (object.ok()) object = compiler::withIr(object.value(), *compiled);
  if (!object.ok()) return failed(object.error());
  return {.verdict = compile::kVerdictCompiled, .report = std::move(report), .image = runtime::sealed(object.value())};
}

} // namespace

Outcome compileSources(std::string_view packed) {
  return outcomeOf([&] {
    std::string problem;
    const std::optional<compile::Sources> given = compile::unpacked(packed, problem);
    return given ? compile(*given) : failed(std::move(problem));
  });
}

} // namespace rung::rung_compile
