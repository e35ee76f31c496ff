// RUNG_CHECK: a broken invariant of Rung's own code ends the process, in every build type.
#pragma once

namespace rung {

/// As long as an object of this class exists on a thread, a failing check on that thread throws std::logic_error
/// instead: a library must not end the process of its host.
class ThrowingChecks {
public:
  ThrowingChecks() noexcept;
  ~ThrowingChecks();
  ThrowingChecks(const ThrowingChecks&) = delete;
  ThrowingChecks& operator=(const ThrowingChecks&) = delete;
};

/// Prints the failed condition and its place, then aborts.
[[noreturn]] void checkFailed(const char* condition, const char* message, const char* file, int line);

} // namespace rung

#define RUNG_CHECK(condition, message)                                                                                 \
  ((condition) ? static_cast<void>(0) : ::rung::checkFailed(#condition, message, __FILE__, __LINE__))
