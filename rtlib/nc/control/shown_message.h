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
  // The same message with the same values: then a program has one text for both.
  bool isSameButText(const ShownMessage& other) const {
    return number == other.number && channel == other.channel && index == other.index && value == other.value &&
           real == other.real && par2 == other.par2 && par3 == other.par3;
  }
};

// What the machine's configuration says of one message.
struct DefinedMessage {
  uint32_t number = 0;
  bool lasts = false;      // it is shown until the program ends it, else until the operator confirms it
  bool loggedOnly = false; // it is not shown
  std::string text;        // %d, %x and %X are places for the values of the message
};

// Characters that Control::describe may write; longer texts are cut off.
inline constexpr size_t kMessageLine = 400;

} // namespace rung::nc
