// Which Rung this is.
#pragma once

namespace rung {

const char* version(); // "0.1"
// "rungc 0.1", as compiled programs name their compiler.
const char* compilerName();

} // namespace rung
