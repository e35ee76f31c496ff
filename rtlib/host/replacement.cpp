// A program that is to take over (see replacement.h).
#include "rtlib/host/replacement.h"

namespace rung::host {

Replacement::Replacement(const rung_program& running, const Runnable& next)
    : loaded_(next), there_(running, next.program), back_(next.program, running) {}

} // namespace rung::host
