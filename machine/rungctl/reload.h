// rungctl reload: a compiled program, or sources, which the host compiles; rungctl rollback.
#pragma once
#include "machine/rungctl/words.h"

namespace rung::rungctl {

// The exit status. `stop` is not 0 when the user has interrupted the command.
int reload(Client& client, const Words& words, const volatile int& stop);
int rollback(Client& client, const Words& words);

} // namespace rung::rungctl
