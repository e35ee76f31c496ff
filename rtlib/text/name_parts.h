// The prefixes and suffixes of a name of a PLC program that select a part of its cell.
#pragma once
#include <string_view>

namespace rung::text {

// Prefix of a name: the 64-bit real at its address.
inline constexpr std::string_view kRealPrefix = "REAL.";

// The name without its bit, index, width or offset: SYM of SYM.3, SYM,#2, SYM[2], !SYM, REAL.SYM.
constexpr std::string_view headOf(std::string_view name) {
  for (const std::string_view before : {std::string_view("!"), kRealPrefix, std::string_view("!")})
    if (name.starts_with(before)) name.remove_prefix(before.size());
  return name.substr(0, name.find_first_of(".,[:+"));
}

} // namespace rung::text
