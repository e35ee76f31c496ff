// Numbers as written in the configuration of the control.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace rung::nc::technol {

// 12, -12, 0x0C and the other forms of text::writtenNumber; nothing for any other text.
std::optional<int64_t> integerOf(std::string_view text);
// 12, -0.5, 1e3; nothing if the text is not a finite number.
std::optional<double> realOf(std::string_view text);

} // namespace rung::nc::technol
