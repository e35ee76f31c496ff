// See version.h; the build knows the number.
#include "ir/support/version.h"

namespace rung {

const char* compilerName() { return "rungc " RUNG_VERSION; }

} // namespace rung
