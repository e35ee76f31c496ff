// The sentence of each thread.
#include "rtlib/api/error.h"

#include <cstdarg>
#include <cstdio>

namespace rung::api {

namespace {

// Within the memory that the dynamic linker reserves for every thread: the first use allocates nothing.
[[gnu::tls_model("initial-exec")]] thread_local char sentence[320];

} // namespace

int32_t fail(rung_status status, const char* format, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  char whole[sizeof sentence + 1]; // a character more, to see where the last one begins
  std::vsnprintf(whole, sizeof whole, format, arguments);
  va_end(arguments);
  putText(sentence, whole);
  return status;
}

const char* errorText() noexcept { return sentence; }

} // namespace rung::api
