// What an image of the runtime's library is served by: code of it made anew, from what it was compiled from.
#pragma once
#include <functional>

#include "compiler/engines.h"
#include "ir/support/result.h"
#include "rung/runtime.h"

namespace rung::compiler {

// What a program was compiled from; a failure says why that is not known.
using GetCompiled = std::function<Result<const Compiled*>()>;

// See rung_image_serve. `compiled` is asked when code is made, by any thread; what it gives outlives that.
int32_t serveImage(rung_image* image, GetCompiled compiled, EngineKind kind, const EngineOptions& options);

} // namespace rung::compiler
