// What fails within the compiler as a Result.
#pragma once
#include <stdexcept>

#include "ir/support/check.h"
#include "ir/support/result.h"

namespace rung {

/// What `body` gives, a Result; a failure with the text of a RUNG_CHECK in it, which then does not end the process.
template <class Body>
auto contained(Body body) -> decltype(body()) {
  try {
    const ThrowingChecks throwing;
    return body();
  } catch (const std::logic_error& error) {
    return failure(error.what());
  }
}

} // namespace rung
