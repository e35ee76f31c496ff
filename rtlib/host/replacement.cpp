// A program that is to take over (see replacement.h).
#include "rtlib/host/replacement.h"

namespace rung::host {

Replacement::Replacement(const rung_program& running, const rung_program& next, void* engine)
    : loaded_(next, engine), there_(running, next), back_(next, running) {}

} // namespace rung::host
