// What is written around a name of a PLC program to say which part of its cell is meant.
#pragma once
#include <string_view>

namespace rung::text {

// Before a name: the real of 64 bits that begins there.
inline constexpr std::string_view kRealPrefix = "REAL.";

// What a name is a part of: the name without its bit, index, width or distance, SYM of SYM.3, SYM,#2, SYM[2], !SYM,
// REAL.SYM.
constexpr std::string_view headOf(std::string_view name) {
  for (const std::string_view before : {std::string_view("!"), kRealPrefix, std::string_view("!")})
    if (name.starts_with(before)) name.remove_prefix(before.size());
  return name.substr(0, name.find_first_of(".,[:+"));
}

} // namespace rung::text
