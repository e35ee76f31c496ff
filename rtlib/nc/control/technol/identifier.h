// Identifiers of logical inputs and outputs: dotted names in any case (man. l.12679-12709). An index of zero means the
// same as no index, leading zeros are ignored, and `CNC.` may come first.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rung::nc::technol {

// The canonical form: upper case, indices without leading zeros, no zero index, no blanks around it.
std::string canonical(std::string_view identifier);

// A canonical identifier of a connection without its suffixes: `.BIT[k]`, and before it the index of an element.
struct Reference {
  std::string_view base;
  uint32_t element = 0;
  std::optional<uint32_t> bit;
};
// withoutBit removes the bit, withoutIndex the index, too.
Reference withoutBit(std::string_view canonicalName);
Reference withoutIndex(Reference reference);

// Takes "[12]" from the beginning of the text.
std::optional<uint32_t> takeIndex(std::string_view& text);
// Takes `prefix` from the beginning of the text.
bool takePrefix(std::string_view& text, std::string_view prefix);
// The characters, up to the first zero, of an identifier that is passed as words of eight characters. `room` stores
// them.
std::string_view charactersOf(std::span<const int64_t> words, std::span<char> room);
// A number below 2^31 that consists of decimal digits only.
std::optional<uint32_t> decimal(std::string_view text);

} // namespace rung::nc::technol
