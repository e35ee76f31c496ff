// The structs of rung/runtime.h between a host and a library of different age: `size` says what the host knows.
#pragma once
#include <algorithm>
#include <cstring>
#include <span>
#include <string_view>

#include "rtlib/api/error.h"
#include "rtlib/text/utf8.h"

namespace rung::api {

inline int32_t failSize(const char* name) noexcept {
  return fail(
      RUNG_BAD_ARGUMENT,
      "%s is null, its field `size` is not set to the size of the struct, or a field is set that this library does "
      "not know",
      name);
}

// A host knows no field, or knows them up to one of them: the size of a struct of any version is a multiple of its
// alignment, so no field is cut.
template <class Struct>
bool hasSize(const Struct* host) noexcept {
  constexpr uint32_t kMost = 1 << 16;
  return host->size >= 2 * sizeof(uint32_t) && host->size <= kMost && host->size % alignof(Struct) == 0;
}

// What the host gives; null: as `to` has it. False: its size cannot be right, or it asks for something that this
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

// What the host gets: as much of it as it knows, and zeros where it knows more.
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

// The characters that fit, ended by 0.
inline void putText(std::span<char> to, std::string_view from) noexcept {
  *std::ranges::copy(text::wholeCharacters(from, to.size() - 1), to.begin()).out = 0;
}

} // namespace rung::api
