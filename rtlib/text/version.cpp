// See version.h.
#include "rtlib/text/version.h"

namespace rung::text {

const char* version() { return RUNG_VERSION; }
const char* compilerName() { return "rungc " RUNG_VERSION; }

} // namespace rung::text
