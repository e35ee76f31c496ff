// Lines of the protocol between another program and a host, as they are.
#pragma once
#include <iosfwd>

#include "machine/control/connection.h"

namespace rung::rungctl {

// From `in` to the host and from the host to `out`, until one of them ends or `stop` is not 0. Throws
// std::runtime_error where a line is longer than a request may be.
void relay(control::Connection& host, int in, std::ostream& out, const volatile int& stop);

} // namespace rung::rungctl
