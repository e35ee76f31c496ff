// RUNG_CHECK: broken invariants of our own code end the program, in every build type.
#pragma once

namespace rung {

/// Prints what failed and where, then aborts.
[[noreturn]] void checkFailed(const char* condition, const char* message, const char* file, int line);

} // namespace rung

#define RUNG_CHECK(condition, message)                                                                                 \
  ((condition) ? static_cast<void>(0) : ::rung::checkFailed(#condition, message, __FILE__, __LINE__))
