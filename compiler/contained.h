// Calls the compiler from functions of a C library.
#pragma once
#include "ir/support/check.h"
#include "rtlib/api/error.h"

namespace rung::compiler {

// Catches all exceptions, so that none leaves the library and internal errors of the compiler do not end the process.
template <class Body>
int32_t contained(Body body) noexcept {
  return api::contained([&] {
    const ThrowingChecks throwing;
    return body();
  });
}

} // namespace rung::compiler
