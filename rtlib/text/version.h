// The version of Rung.
#pragma once

namespace rung::text {

const char* version(); // "0.1"
// "rungc 0.1", as compiled programs name their compiler.
const char* compilerName();

} // namespace rung::text
