// See version.h.
#include "ir/support/version.h"

namespace rung {

const char* version() { return RUNG_VERSION; }
const char* compilerName() { return "rungc " RUNG_VERSION; }

} // namespace rung
