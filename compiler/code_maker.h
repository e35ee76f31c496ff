// Serves an image of the runtime library: recompiles it from what it was compiled from.
#pragma once
#include <functional>

#include "compiler/engines.h"
#include "ir/support/result.h"
#include "rung/runtime.h"

namespace rung::compiler {

// Returns what a program was compiled from; the error says why that is not known.
using GetCompiled = std::function<Result<const Compiled*>()>;

// See rung_image_serve. `compiled` is called when code is made, on any thread; its result must outlive that.
int32_t serveImage(rung_image* image, GetCompiled compiled, EngineKind kind, const EngineOptions& options);

} // namespace rung::compiler
