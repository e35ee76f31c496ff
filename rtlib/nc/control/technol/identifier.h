// Identifiers of logical inputs and outputs: dotted names in any case (man. l.12679-12709). An index of zero is the
// same as none and leading zeros do not count; `CNC.` may come first.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rung::nc::technol {

// The one way to write it: upper case, indices without leading zeros, none that is zero, nothing around it.
std::string canonical(std::string_view identifier);

// What a connection adds to a canonical identifier: `.BIT[k]`, and before it the index of an element.
struct Reference {
  std::string_view base;
  uint32_t element = 0;
  std::optional<uint32_t> bit;
};
// The bit alone, or the bit and the index.
Reference withoutBit(std::string_view canonicalName);
Reference withoutIndex(Reference reference);

// "[12]" at the beginning of the text, which loses it.
std::optional<uint32_t> takeIndex(std::string_view& text);
// `prefix` at the beginning of the text, which loses it.
bool takePrefix(std::string_view& text, std::string_view prefix);
// The characters of an identifier that came as words of eight, up to the first zero; they are put into `room`.
std::string_view charactersOf(std::span<const int64_t> words, std::span<char> room);
// Decimal digits and nothing else, below 2^31.
std::optional<uint32_t> decimal(std::string_view text);

} // namespace rung::nc::technol
