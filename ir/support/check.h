// RUNG_CHECK: broken invariants of our own code end the program, in every build type.
#pragma once

namespace rung {

/// As long as one is alive in a thread, what fails there is thrown, as a std::logic_error: a library does not end the
/// process of its host.
class ThrowingChecks {
public:
  ThrowingChecks() noexcept;
  ~ThrowingChecks();
  ThrowingChecks(const ThrowingChecks&) = delete;
  ThrowingChecks& operator=(const ThrowingChecks&) = delete;
};

/// Prints what failed and where, then aborts.
[[noreturn]] void checkFailed(const char* condition, const char* message, const char* file, int line);

} // namespace rung

#define RUNG_CHECK(condition, message)                                                                                 \
  ((condition) ? static_cast<void>(0) : ::rung::checkFailed(#condition, message, __FILE__, __LINE__))
