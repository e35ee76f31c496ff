// Identifiers (see identifier.h).
#include "rtlib/nc/control/technol/identifier.h"

#include <algorithm>

#include "rtlib/nc/control/technol/values.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::nc::technol {
namespace {

// The digits of an index after a '[', without leading zeros ("" for zero); nothing without an index.
std::optional<std::string_view> digitsOfIndex(std::string_view rest) {
  size_t end = 0;
  while (end < rest.size() && text::isDigit(rest[end])) ++end;
  if (end == 0 || end == rest.size() || rest[end] != ']') return std::nullopt;
  const size_t first = std::min(rest.find_first_not_of('0'), end);
  return rest.substr(first, end - first);
}

} // namespace

std::string canonical(std::string_view identifier) {
  identifier = text::trimmed(identifier);
  std::string made;
  made.reserve(identifier.size());
  for (size_t i = 0; i < identifier.size(); ++i) {
    const auto digits = identifier[i] == '[' ? digitsOfIndex(identifier.substr(i + 1)) : std::nullopt;
    if (!digits) {
      made += text::upper(identifier[i]);
      continue;
    }
    if (!digits->empty()) made.append("[").append(*digits).append("]");
    i = identifier.find(']', i);
  }
  return made.starts_with("CNC.") ? made.substr(4) : made;
}

std::string_view charactersOf(std::span<const int64_t> words, std::span<char> room) {
  const size_t most = std::min(words.size() * 8, room.size());
  size_t length = 0;
  for (; length < most; ++length) {
    const auto word = static_cast<uint64_t>(words[length / 8]);
    room[length] = static_cast<char>(word >> length % 8 * 8);
    if (room[length] == 0) break;
  }
  return {room.data(), length};
}

std::optional<uint32_t> decimal(std::string_view text) {
  const auto value = text::numberIn<uint32_t>(text);
  return value && *value <= INT32_MAX ? value : std::nullopt;
}

std::optional<uint32_t> takeIndex(std::string_view& text) {
  const size_t end = text.find(']');
  if (text.empty() || text.front() != '[' || end == std::string_view::npos) return std::nullopt;
  const auto value = decimal(text.substr(1, end - 1));
  if (value) text.remove_prefix(end + 1);
  return value;
}

bool takePrefix(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

Reference withoutBit(std::string_view name) {
  constexpr std::string_view kBit = ".BIT";
  Reference made{.base = name, .element = 0, .bit = {}};
  if (name.ends_with(kBit)) {
    made.base.remove_suffix(kBit.size());
    made.bit = 0;
    return made;
  }
  const size_t at = name.rfind(".BIT[");
  if (at == std::string_view::npos) return made;
  std::string_view rest = name.substr(at + kBit.size());
  const auto number = takeIndex(rest);
  if (!number || !rest.empty()) return made;
  made.base = name.substr(0, at);
  made.bit = number;
  return made;
}

Reference withoutIndex(Reference reference) {
  const size_t at = reference.base.rfind('[');
  if (at == std::string_view::npos || !reference.base.ends_with(']')) return reference;
  std::string_view index = reference.base.substr(at);
  const auto number = takeIndex(index);
  if (!number || !index.empty()) return reference;
  reference.element = *number;
  reference.base = reference.base.substr(0, at);
  return reference;
}

} // namespace rung::nc::technol
