// The signals that end a command which runs until it is stopped.
#pragma once
#include "tools/scenario/prompt.h"

namespace rung::rungc {

// Catches SIGINT and SIGTERM from now on. The signal that has come; 0: none.
scenario::Signal& catchStop();

} // namespace rung::rungc
