// The signals that end a command which runs until it is stopped.
#pragma once
#include "tools/scenario/prompt.h"

namespace rung::rungc {

// The first one catches SIGINT and SIGTERM from now on. The signal that has come; 0: none.
scenario::Signal& catchStop();
scenario::Signal& stopSignal();

} // namespace rung::rungc
