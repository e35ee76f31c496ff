// Which Rung this is.
#pragma once

namespace rung {

// "rungc 0.1", as compiled programs name their compiler and as the command names itself.
const char* compilerName();

} // namespace rung
