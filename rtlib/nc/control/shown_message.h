// A message of the program as the control shows it to its operator.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace rung::nc {

struct ShownMessage {
  uint32_t number = 0;
  int32_t channel = 0;
  int32_t index = 0;
  int64_t value = 0; // the bits of a double when `real`; TECHNOL: par1
  bool real = false;
  std::string text;
  uint32_t par2 = 0, par3 = 0; // TECHNOL
  bool operator==(const ShownMessage&) const = default;
};

// Characters that Control::describe may write; longer texts are cut off.
inline constexpr size_t kMessageLine = 400;

} // namespace rung::nc
