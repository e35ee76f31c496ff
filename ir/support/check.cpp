// Out-of-line part of RUNG_CHECK, so that a check costs only a branch.
#include "ir/support/check.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace rung {
namespace {

thread_local int throwing = 0;

} // namespace

ThrowingChecks::ThrowingChecks() noexcept { ++throwing; }
ThrowingChecks::~ThrowingChecks() { --throwing; }

void checkFailed(const char* condition, const char* message, const char* file, int line) {
  if (throwing > 0)
    throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": internal error: " + message + " (" +
                           condition + ")");
  std::fprintf(stderr, "%s:%d: internal error: %s (%s)\n", file, line, message, condition);
  std::abort();
}

} // namespace rung
