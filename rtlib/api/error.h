// How the functions of a library of C report what was wrong: a status, and a sentence for the thread. Each library has
// sentences of its own.
#pragma once
#include <cstdint>
#include <exception>
#include <new>

#include "rung/runtime.h"

namespace rung::api {

// Keeps the sentence and gives the status. Allocates nothing.
[[gnu::format(printf, 2, 3)]] int32_t fail(rung_status status, const char* format, ...) noexcept;
// The sentence of the thread's last error, "" before the first.
const char* errorText() noexcept;

// Runs what may throw; no exception leaves the library.
template <class Body>
int32_t contained(Body body) noexcept {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(RUNG_OUT_OF_MEMORY, "there is not enough memory");
  } catch (const std::exception& thrown) {
    return fail(RUNG_FAILED, "%s", thrown.what());
  }
}

} // namespace rung::api
