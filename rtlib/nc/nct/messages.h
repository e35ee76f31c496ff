// Messages of NCT programs (man. §6.13): their codes, the words that a message box shares with the NC, and the numbers
// printed in their texts. Shared by compiler, simulation and hosts.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "rung/program.h"

namespace rung::nc::nct {

inline constexpr uint32_t kMessages = 999; // numbers 1 to 999
inline constexpr uint32_t kMostIndex = 99; // of channel and arbitrary index

// AA0CCCDD: channel index, 0 for the PLC, number, arbitrary index (l.2833-2842).
constexpr uint32_t messageCode(uint32_t number, uint32_t channel, uint32_t index) {
  return channel * 1'000'000 + number * 100 + index;
}

// Every message box owns two words of this space. The program writes `wanted`: the code that it sent with the rising
// edge of its input, plus kLogCell if the message goes to the log only; 0 if it sends none. The NC sets `shown` while
// that code is on the screen, or when it has been entered in the log; the box clears both words at the falling edge.
inline constexpr const char* kMessageSpace = "@SHOWN";
inline constexpr uint32_t kWantedWord = 0;
inline constexpr uint32_t kShownWord = 1;
inline constexpr uint32_t kMessageWords = 2;
inline constexpr uint32_t kLogCell = 1u << 31;

// {#0:F0} or {*0:Fi} (l.2749-2773).
struct Placeholder {
  size_t length = 0; // characters
  bool real = false;
  int decimals = 0;
};
// Reads the placeholder that begins with the `{` at text[0]; nothing if it is not a placeholder.
std::optional<Placeholder> readPlaceholder(std::string_view text);

// Writes the text with the message's value in place of its placeholders. Returns the number of characters written;
// longer texts are cut off. Allocates nothing.
size_t fillText(std::string_view text, const rung_message& message, std::span<char> out);

} // namespace rung::nc::nct
