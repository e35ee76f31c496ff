// The requests of Modbus TCP that a server takes, as bytes: whole messages, and what they ask for. Nothing here trusts
// the other side.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "machine/host/mapping_file.h"

namespace rung::io {

inline constexpr size_t kLongestMessage = 260; // bytes, with its header

enum class Exception : uint8_t { None = 0, Function = 1, Address = 2, Value = 3 };

// The bytes of the message that `bytes` begin with: 0 where too few are there to know. Nothing: it is not a request of
// Modbus TCP, and what comes after it cannot be understood.
std::optional<size_t> messageLength(std::span<const uint8_t> bytes);

struct Request {
  host::Area area = host::Area::Coil;
  bool writes = false;
  uint32_t first = 0;              // of the places
  uint32_t count = 0;              // `first` + `count` is at most 65536
  std::span<const uint8_t> values; // of registers that are written, two bytes each, the high one first
};

// `message` is a whole one. What is wrong with it, or None and `request`.
Exception parseRequest(std::span<const uint8_t> message, Request& request);

} // namespace rung::io
