// Out-of-line part of RUNG_CHECK, so that a check costs one branch at its place.
#include "ir/support/check.h"

#include <cstdio>
#include <cstdlib>

namespace rung {

void checkFailed(const char* condition, const char* message, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: internal error: %s (%s)\n", file, line, message, condition);
  std::abort();
}

} // namespace rung
