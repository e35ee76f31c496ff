// How people write a message's number.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace rung::nc {

inline constexpr size_t kMessageNumber = 64; // characters: more than any has

// The number as the program has it, and which message of that number it is: "12", "12 (channel 1, index 0)". Gives the
// characters written; what does not fit is cut off. Allocates nothing.
size_t putMessageNumber(uint32_t number, int32_t channel, int32_t index, std::span<char> out) noexcept;

} // namespace rung::nc
