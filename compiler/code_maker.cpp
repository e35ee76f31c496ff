// Recompiles the code of an image (see code_maker.h).
#include "compiler/code_maker.h"

#include <memory>
#include <utility>

#include "compiler/contained.h"
#include "compiler/recompiler.h"
#include "rtlib/api/error.h"

namespace rung::compiler {
namespace {

struct Maker {
  GetCompiled compiled;
  EngineKind kind;
  EngineOptions options;
};

Result<std::unique_ptr<ForcedCode>> forcedCode(const Maker& maker, const rung_program& program, void* engine,
                                               std::span<const rung_forced_byte> forced) {
  const Result<const Compiled*> compiled = maker.compiled();
  if (!compiled.ok()) return failure("rungs write a variable that is to be forced, and " + compiled.error());
  return makeForcedCode(*compiled.value(), maker.kind, maker.options, program, engine, forced);
}

int32_t makeForced(void* user, const rung_image* image, void* engine, const rung_forced_byte* forced, uint32_t count,
                   rung_forced_code* code, char* problem, size_t problemBytes) {
  const int32_t status = contained([&] {
    auto made = forcedCode(*static_cast<const Maker*>(user), *rung_image_program(image), engine, {forced, count});
    if (!made.ok()) return api::fail(RUNG_FAILED, "%s", made.error().c_str());
    ForcedCode* owner = std::move(made).value().release();
    *code = {.chunk_fns = owner->code().functions,
             .engine = owner->code().engine,
             .release = [](void* object) { delete static_cast<ForcedCode*>(object); },
             .owner = owner};
    return int32_t{RUNG_OK};
  });
  if (status != RUNG_OK) api::putText({problem, problemBytes}, api::errorText());
  return status;
}

} // namespace

int32_t serveImage(rung_image* image, GetCompiled compiled, EngineKind kind, const EngineOptions& options) {
  auto maker = std::make_unique<Maker>(Maker{std::move(compiled), kind, options});
  const rung_code_maker described{.size = sizeof described,
                                  .force = &makeForced,
                                  .release = [](void* user) { delete static_cast<Maker*>(user); },
                                  .user = maker.get()};
  const int32_t status = rung_image_serve(image, &described);
  if (status != RUNG_OK) return status;
  [[maybe_unused]] const Maker* images = maker.release(); // owned by the image now
  return RUNG_OK;
}

} // namespace rung::compiler
