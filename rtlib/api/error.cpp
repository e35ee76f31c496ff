// The error sentence of each thread.
#include "rtlib/api/error.h"

#include <cstdarg>
#include <cstdio>

namespace rung::api {

namespace {

// Placed in the memory that the dynamic linker reserves for every thread, so that the first use does not allocate.
[[gnu::tls_model("initial-exec")]] thread_local char sentence[320];

} // namespace

int32_t fail(rung_status status, const char* format, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  char whole[sizeof sentence + 1]; // one byte more, to find where the last character begins
  std::vsnprintf(whole, sizeof whole, format, arguments);
  va_end(arguments);
  putText(sentence, whole);
  return status;
}

const char* errorText() noexcept { return sentence; }

} // namespace rung::api
