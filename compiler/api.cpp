// The functions of rung/compiler.h: sources to diagnostics, an image, a file.
#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "compiler/code_maker.h"
#include "compiler/compile.h"
#include "compiler/configuration.h"
#include "compiler/contained.h"
#include "compiler/dialect_choice.h"
#include "compiler/embedded_ir.h"
#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "rtlib/api/error.h"
#include "rtlib/load/seal.h"
#include "rung/compiler.h"
#include "rung/runtime.hpp"

namespace rung::compiler {
namespace {

// A diagnostic with the texts that rung_diagnostic points to.
struct Shown {
  Severity severity;
  LineCol place;
  std::string file, code, message;
};

// The parts of a compilation that an image needs after it has been freed.
struct Program {
  SourceManager sources;
  std::optional<Compiled> compiled;
};

struct Running {
  std::shared_ptr<const Program> program;
  std::unique_ptr<runtime::Engine> engine;
};

} // namespace
} // namespace rung::compiler

using namespace rung;
using namespace rung::compiler;
using api::checked;
using api::fail;
using api::failHandle;

struct rung_compilation {
  uint32_t mark = api::kCompilationMark;
  std::shared_ptr<Program> program = std::make_shared<Program>();
  EngineKind kind = EngineKind::Jit;
  EngineOptions engine;
  std::vector<Shown> diagnostics;
  std::string report;
};

namespace {

rung_compilation* compilationOf(const rung_compilation* handle) noexcept {
  return const_cast<rung_compilation*>(checked(handle, api::kCompilationMark));
}

int32_t addSources(const rung_source* sources, uint32_t count, SourceManager& to, std::vector<FileId>& files) {
  for (uint32_t i = 0; i < count; ++i) {
    const rung_source& source = sources[i];
    if (source.name == nullptr) return fail(RUNG_BAD_ARGUMENT, "source %u has no name", i);
    if (source.text != nullptr) {
      files.push_back(to.addBytes(source.name, std::string(source.text, source.bytes)));
      continue;
    }
    const Result<FileId> file = to.addFile(source.name);
    if (!file.ok()) return fail(RUNG_NOT_FOUND, "%s cannot be read: %s", source.name, file.error().c_str());
    files.push_back(file.value());
  }
  return RUNG_OK;
}

int32_t takeSettings(const rung_compile_options& options, CompileRequest& request) {
  if (options.settings == nullptr && options.setting_count != 0)
    return fail(RUNG_BAD_ARGUMENT, "the settings are null, their number is not 0");
  for (uint32_t i = 0; i < options.setting_count; ++i) {
    const rung_setting& setting = options.settings[i];
    if (setting.key == nullptr || setting.value == nullptr)
      return fail(RUNG_BAD_ARGUMENT, "setting %u has no key or no value", i);
    request.options.config[setting.key] = setting.value;
  }
  return RUNG_OK;
}

int32_t checkSettings(const SourceManager& sources, std::span<const FileId> files, const CompileRequest& request) {
  Diagnostics discarded; // the compilation reports it
  const frontend::Dialect* dialect = chooseDialect(sources, files, request.dialect, discarded);
  if (dialect == nullptr) return RUNG_OK;
  for (const auto& [key, value] : request.options.config)
    if (const auto problem = checkSetting(*dialect, key, value))
      return fail(RUNG_BAD_ARGUMENT, "%s", problem->text.c_str());
  return RUNG_OK;
}

void takeDiagnostics(const Diagnostics& diagnostics, rung_compilation& to) {
  const SourceManager& sources = to.program->sources;
  for (const Diagnostic* d : diagnostics.sorted()) {
    Shown shown{.severity = d->severity, .code = std::string(diagInfo(d->id).code), .message = messageOf(*d)};
    if (d->range.valid()) {
      shown.place = sources.lineCol(d->range.begin);
      shown.file = sources.name(sources.fileOf(d->range.begin));
    }
    to.diagnostics.push_back(std::move(shown));
  }
  to.report = renderText(diagnostics, sources);
}

int32_t compileInto(const rung_source* sources, uint32_t count, const rung_compile_options& options,
                    rung_compilation& to) {
  CompileRequest request;
  request.dialect = options.dialect != nullptr ? options.dialect : "";
  request.options.strict = (options.flags & RUNG_COMPILE_STRICT) != 0;
  request.instrument = (options.flags & RUNG_COMPILE_PROFILE) != 0;
  constexpr EngineKind kKinds[] = {EngineKind::Jit, EngineKind::Jit, EngineKind::Interp, EngineKind::Tiered};
  to.kind = kKinds[options.engine];
  to.engine.optimise = options.engine != RUNG_ENGINE_FAST;
  to.engine.debugger = (options.flags & RUNG_COMPILE_DEBUG) != 0;
  to.engine.cacheFolder = options.cache_folder != nullptr ? options.cache_folder : "";
  Program& program = *to.program;
  std::vector<FileId> files;
  if (const int32_t status = takeSettings(options, request); status != RUNG_OK) return status;
  if (const int32_t status = addSources(sources, count, program.sources, files); status != RUNG_OK) return status;
  if (const int32_t status = checkSettings(program.sources, files, request); status != RUNG_OK) return status;
  Diagnostics diagnostics;
  request.keepBuilt = true;
  program.compiled = compile(program.sources, files, request, diagnostics);
  takeDiagnostics(diagnostics, to);
  if (program.compiled) return RUNG_OK;
  return fail(RUNG_REFUSED, "%s has %zu errors: rung_compilation_report has them", sources[0].name,
              diagnostics.errorCount());
}

} // namespace

const char* rung_compiler_error_text(void) { return api::errorText(); }

int32_t rung_compile(const rung_source* sources, uint32_t count, const rung_compile_options* options,
                     rung_compilation** compilation) {
  if (sources == nullptr || count == 0 || compilation == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "rung_compile needs a source at least, and a place for the compilation");
  rung_compile_options given{};
  if (!api::takeStruct(options, given)) return api::failSize("rung_compile_options");
  if (given.engine > RUNG_ENGINE_TIERED) return fail(RUNG_BAD_ARGUMENT, "%u is not an enum rung_engine", given.engine);
  return compiler::contained([&] {
    auto made = std::make_unique<rung_compilation>();
    const int32_t status = compileInto(sources, count, given, *made);
    if (status == RUNG_OK || status == RUNG_REFUSED) *compilation = made.release();
    return status;
  });
}

int32_t rung_compilation_free(rung_compilation* compilation) {
  return api::endHandle(compilation, api::kCompilationMark, "a compilation");
}

int32_t rung_compilation_diagnostic(const rung_compilation* compilation, uint32_t index, rung_diagnostic* diagnostic) {
  const rung_compilation* handle = compilationOf(compilation);
  if (handle == nullptr) return failHandle("a compilation");
  if (index >= handle->diagnostics.size()) return RUNG_EMPTY;
  const Shown& shown = handle->diagnostics[index];
  return api::giveStruct(diagnostic, rung_diagnostic{.severity = shown.severity == Severity::Error
                                                                     ? uint32_t{RUNG_SEVERITY_ERROR}
                                                                     : uint32_t{RUNG_SEVERITY_WARNING},
                                                     .line = shown.place.line,
                                                     .column = shown.place.column,
                                                     .file = shown.file.c_str(),
                                                     .code = shown.code.c_str(),
                                                     .message = shown.message.c_str()});
}

const char* rung_compilation_report(const rung_compilation* compilation) {
  const rung_compilation* handle = compilationOf(compilation);
  return handle != nullptr ? handle->report.c_str() : nullptr;
}

namespace {

// Reports an error of the runtime to the caller of this library.
int32_t failAsRuntime(int32_t status) { return fail(static_cast<rung_status>(status), "%s", rung_error_text()); }

int32_t serve(rung_image* image, const std::shared_ptr<const Program>& program, EngineKind kind,
              const EngineOptions& options) {
  const auto compiled = [program]() -> Result<const Compiled*> { return &*program->compiled; };
  const int32_t status = serveImage(image, compiled, kind, options);
  return status == RUNG_OK ? status : failAsRuntime(status);
}

int32_t failErrors() noexcept { return fail(RUNG_WRONG_STATE, "the program has errors: see its diagnostics"); }

} // namespace

int32_t rung_compilation_image(rung_compilation* compilation, rung_image** image) {
  const rung_compilation* handle = compilationOf(compilation);
  if (handle == nullptr) return failHandle("a compilation");
  if (image == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the image is null");
  if (!handle->program->compiled) return failErrors();
  return compiler::contained([&] {
    Result<std::unique_ptr<runtime::Engine>> made =
        makeEngine(handle->kind, *handle->program->compiled, handle->engine);
    if (!made.ok()) return fail(RUNG_FAILED, "%s", made.error().c_str());
    const auto end = [](void* owner) { delete static_cast<Running*>(owner); };
    Running* running = std::make_unique<Running>(handle->program, std::move(made).value()).release();
    runtime::Engine& engine = *running->engine;
    const int32_t status = rung_image_adopt(&engine.program(), engine.context(), end, running, image);
    if (status != RUNG_OK) {
      end(running);
      return failAsRuntime(status);
    }
    const int32_t served = serve(*image, handle->program, handle->kind, handle->engine);
    if (served != RUNG_OK) rung_image_close(*image);
    return served;
  });
}

int32_t rung_compilation_write(rung_compilation* compilation, const char* path) {
  const rung_compilation* handle = compilationOf(compilation);
  if (handle == nullptr) return failHandle("a compilation");
  if (path == nullptr) return fail(RUNG_BAD_ARGUMENT, "the name of the file is null");
  if (!handle->program->compiled) return failErrors();
  return compiler::contained([&] {
    const Compiled& compiled = *handle->program->compiled;
    Result<std::string> object = sharedObject(compiled, handle->engine);
    if (object.ok()) object = withIr(object.value(), compiled);
    if (!object.ok()) return fail(RUNG_FAILED, "%s", object.error().c_str());
    const std::string error = runtime::writeProgram(path, runtime::sealed(object.value()));
    return error.empty() ? int32_t{RUNG_OK} : fail(RUNG_FAILED, "%s", error.c_str());
  });
}

int32_t rung_compiler_serve(rung_image* image) {
  const rung_program* program = rung_image_program(image);
  if (program == nullptr) return failHandle("an image");
  return compiler::contained([&] {
    const std::string file = fileOf(image);
    if (file.empty()) return fail(RUNG_REFUSED, "the image was not opened from a file: its maker serves it");
    Result<Compiled> compiled = irOf(runtime::readSealed(file).image, hashesOf(*program));
    if (!compiled.ok()) return fail(RUNG_REFUSED, "the file of %s: %s", program->name, compiled.error().c_str());
    auto kept = std::make_shared<Program>();
    kept->compiled = std::move(compiled).value();
    return serve(image, std::move(kept), EngineKind::Jit, {});
  });
}
