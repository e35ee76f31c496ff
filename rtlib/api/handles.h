// Handles as a library of C gives them away: each is marked with its kind as long as it is alive.
#pragma once
#include <cstdint>

#include "rtlib/api/error.h"

namespace rung::api {

inline constexpr uint32_t kImageMark = 0x52494D47;
inline constexpr uint32_t kInstanceMark = 0x52494E53;
inline constexpr uint32_t kReplacementMark = 0x5252504C;
inline constexpr uint32_t kWatchMark = 0x52574154;
inline constexpr uint32_t kTraceMark = 0x52545243;
inline constexpr uint32_t kShadowMark = 0x52534857;
inline constexpr uint32_t kForcesMark = 0x52465243;
inline constexpr uint32_t kCompilationMark = 0x52434D50;

// The handle, where it is one; else null.
template <class Handle>
Handle* checked(Handle* handle, uint32_t mark) noexcept {
  const bool aligned = reinterpret_cast<uintptr_t>(handle) % alignof(Handle) == 0;
  return handle != nullptr && aligned && handle->mark == mark ? handle : nullptr;
}

// A freed handle is not one: as far as its memory has no other use yet.
template <class Handle>
void release(Handle* handle) {
  *const_cast<volatile uint32_t*>(&handle->mark) = 0;
  delete handle;
}

inline int32_t failHandle(const char* name) noexcept {
  return fail(RUNG_BAD_HANDLE, "the handle is not that of %s: null, of another kind, or freed before", name);
}

// What the function that ends a handle does. Null is allowed.
template <class Handle>
int32_t endHandle(Handle* handle, uint32_t mark, const char* name) {
  if (handle == nullptr) return RUNG_OK;
  if (checked(handle, mark) == nullptr) return failHandle(name);
  release(handle);
  return RUNG_OK;
}

} // namespace rung::api
