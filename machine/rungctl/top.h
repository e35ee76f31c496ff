// The command rungctl top.
#pragma once
#include "machine/rungctl/words.h"

namespace rung::rungctl {

// Shows a host on the whole terminal, once a second, until q or `stop`; or once as text. A connection that ends is
// shown, and made again when the host is back. Returns the exit status.
int top(const Words& words, const volatile int& stop);

} // namespace rung::rungctl
