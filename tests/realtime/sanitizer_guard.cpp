// The guard by clang's real-time sanitizer: the process ends, with a stack trace, when it notices something.
#include "tests/realtime/guard.h"

// Of the sanitizer, which has no header for them.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {
void __rtsan_realtime_enter();
void __rtsan_realtime_exit();
}
// NOLINTEND(readability-identifier-naming)

namespace rung::test {

struct Guard::State {};

Guard::Guard() = default;
Guard::~Guard() = default;
void Guard::enter() { __rtsan_realtime_enter(); }
void Guard::exit() { __rtsan_realtime_exit(); }
std::string Guard::offences() const { return {}; }
std::vector<Offence> Guard::seen() { return {Offence::Allocation, Offence::Lock, Offence::SystemCall}; }

} // namespace rung::test
