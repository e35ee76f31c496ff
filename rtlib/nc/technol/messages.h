// How the message of a TECHNOL program travels to the control (man. ch. 14): in one rung_message, so that none of its
// values can get lost alone. Compiler, model and hosts read it here.
#pragma once
#include <cstdint>

#include "rung/program.h"

namespace rung::nc::technol {

// number: the message's number, a WORD, with these marks above it; index: subid; value: par1 and above it par2;
// channel: par3. The op is Clear where the program removes a persistent message, else ShowLog.
inline constexpr uint32_t kMessageNumber = 0xFFFF;
inline constexpr uint32_t kPersistentWanted = 1u << 16; // `set` was given, or a bit both begins and ends the message
inline constexpr uint32_t kByBit = 1u << 17;            // of EDEF

struct MessageValues {
  uint32_t number, subId, par[3];
  bool operator==(const MessageValues&) const = default;
};
inline MessageValues valuesOf(const rung_message& message) {
  const auto both = static_cast<uint64_t>(message.value);
  return {message.number & kMessageNumber,
          static_cast<uint32_t>(message.index),
          {static_cast<uint32_t>(both), static_cast<uint32_t>(both >> 32), static_cast<uint32_t>(message.channel)}};
}

} // namespace rung::nc::technol
