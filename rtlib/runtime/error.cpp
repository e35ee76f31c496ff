// The sentence of each thread (see error.h).
#include "rtlib/runtime/error.h"

#include <cstdarg>
#include <cstdio>

namespace rung::runtime {
namespace {

// Within the memory that the dynamic linker reserves for every thread: the first use allocates nothing.
[[gnu::tls_model("initial-exec")]] thread_local char sentence[320];

} // namespace

int32_t fail(rung_status status, const char* format, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(sentence, sizeof sentence, format, arguments);
  va_end(arguments);
  if (length >= static_cast<int>(sizeof sentence)) sentence[wholeCharacters({sentence, sizeof sentence - 1})] = 0;
  return status;
}

// A byte 10xxxxxx continues a character; one that begins with n ones begins one of n bytes.
size_t wholeCharacters(std::string_view cut) noexcept {
  size_t begin = cut.size();
  while (begin > 0 && cut.size() - begin < 3 && (static_cast<uint8_t>(cut[begin - 1]) & 0xC0) == 0x80) --begin;
  if (begin == 0) return cut.size();
  const auto first = static_cast<uint8_t>(cut[begin - 1]);
  const size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
  return cut.size() - begin + 1 < bytes ? begin - 1 : cut.size();
}

const char* errorText() noexcept { return sentence; }

} // namespace rung::runtime
