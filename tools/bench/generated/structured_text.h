// A work in Structured Text of IEC 61131-3, for other vendors' compilers.
#pragma once
#include <string>

#include "ir/support/result.h"
#include "tools/bench/generated/work.h"

namespace rung::bench {

// A program MAIN, and the configuration with an instance of it. A name is a letter for the kind and the number in the
// work; timers are the standard's TON. Fails if the work has mechanisms, which the language lacks.
Result<std::string> structuredText(const Work& work);

} // namespace rung::bench
