// Numbers as the configuration of the control writes them.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace rung::nc::technol {

// 12, -12, 0x0C and the other forms of text::writtenNumber; nothing where it is none.
std::optional<int64_t> integerOf(std::string_view text);
// 12, -0.5, 1e3; finite.
std::optional<double> realOf(std::string_view text);

} // namespace rung::nc::technol
