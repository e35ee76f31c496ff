// How the compiler is called through a library of C.
#pragma once
#include "ir/support/check.h"
#include "rtlib/api/error.h"

namespace rung::compiler {

// No exception leaves the library, and what the compiler finds wrong with itself does not end the process.
template <class Body>
int32_t contained(Body body) noexcept {
  return api::contained([&] {
    const ThrowingChecks throwing;
    return body();
  });
}

} // namespace rung::compiler
