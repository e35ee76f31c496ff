// How the functions of a C library report errors: a status, and a sentence per thread. Each library has its own
// sentences.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <string_view>

#include "rtlib/text/utf8.h"
#include "rung/runtime.h"

namespace rung::api {

// Stores the sentence and returns the status. Allocates nothing.
[[gnu::format(printf, 2, 3)]] int32_t fail(rung_status status, const char* format, ...) noexcept;
// The sentence of the thread's last error, "" before the first.
const char* errorText() noexcept;

// Runs a body that may throw; no exception leaves the library.
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

// Handles of a C library: each is marked with its kind as long as it exists.

inline constexpr uint32_t kImageMark = 0x52494D47;
inline constexpr uint32_t kInstanceMark = 0x52494E53;
inline constexpr uint32_t kReplacementMark = 0x5252504C;
inline constexpr uint32_t kWatchMark = 0x52574154;
inline constexpr uint32_t kTraceMark = 0x52545243;
inline constexpr uint32_t kShadowMark = 0x52534857;
inline constexpr uint32_t kForcesMark = 0x52465243;
inline constexpr uint32_t kCompilationMark = 0x52434D50;

// The handle if it is valid and of this kind; else null.
template <class Handle>
Handle* checked(Handle* handle, uint32_t mark) noexcept {
  const bool aligned = reinterpret_cast<uintptr_t>(handle) % alignof(Handle) == 0;
  return handle != nullptr && aligned && handle->mark == mark ? handle : nullptr;
}

// Clears the mark, so that a freed handle is detected as long as its memory is not used again.
template <class Handle>
void release(Handle* handle) {
  *const_cast<volatile uint32_t*>(&handle->mark) = 0;
  delete handle;
}

inline int32_t failHandle(const char* name) noexcept {
  return fail(RUNG_BAD_HANDLE, "the handle is not that of %s: null, of another kind, or freed before", name);
}

// The body of a function that frees a handle. Null is allowed.
template <class Handle>
int32_t endHandle(Handle* handle, uint32_t mark, const char* name) {
  if (handle == nullptr) return RUNG_OK;
  if (checked(handle, mark) == nullptr) return failHandle(name);
  release(handle);
  return RUNG_OK;
}

// Copies structs of rung/runtime.h between a host and a library of different versions: `size` says which fields the
// host knows.

inline int32_t failSize(const char* name) noexcept {
  return fail(
      RUNG_BAD_ARGUMENT,
      "%s is null, its field `size` is not set to the size of the struct, or a field is set that this library does "
      "not know",
      name);
}

// Whether a size is possible: the host knows all fields up to some field. The size of a struct of any version is a
// multiple of its alignment, so no field is cut.
template <class Struct>
bool hasSize(const Struct* host) noexcept {
  constexpr uint32_t kMost = 1 << 16;
  return host->size >= 2 * sizeof(uint32_t) && host->size <= kMost && host->size % alignof(Struct) == 0;
}

// Copies a struct from the host; null leaves `to` as it is. False: its size is impossible, or it sets a field that this
// library does not know.
template <class Struct>
bool takeStruct(const Struct* host, Struct& to) noexcept {
  if (host == nullptr) return true;
  if (!hasSize(host)) return false;
  const auto* bytes = reinterpret_cast<const unsigned char*>(host);
  for (size_t i = sizeof to; i < host->size; ++i)
    if (bytes[i] != 0) return false;
  std::memcpy(&to, host, std::min<size_t>(host->size, sizeof to));
  return true;
}

// Copies a struct to the host: the fields that it knows, and zeros for fields that only it knows.
template <class Struct>
int32_t giveStruct(Struct* host, const Struct& from) noexcept {
  if (host == nullptr || !hasSize(host)) return failSize("the struct for the result");
  const uint32_t size = host->size;
  const size_t known = std::min<size_t>(size, sizeof from);
  std::memcpy(host, &from, known);
  std::memset(reinterpret_cast<char*>(host) + known, 0, size - known);
  host->size = size;
  return RUNG_OK;
}

// Copies the characters that fit, and ends them with 0.
inline void putText(std::span<char> to, std::string_view from) noexcept {
  *std::ranges::copy(text::wholeCharacters(from, to.size() - 1), to.begin()).out = 0;
}

} // namespace rung::api
