// The character sets of Czech sources. The control keeps a character in one byte; here a program's memory holds
// Windows-1250, and everything outside of it (sources, messages, scenarios) is UTF-8.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rung::nc {

enum class CodePage : uint8_t { Windows1250, Cp852 };

// Which of the two a Czech text is written in, by its letters; Windows-1250 when they do not decide it.
CodePage guessCodePage(std::string_view text);

// The character of a byte. Bytes that the code page leaves free keep their number.
uint32_t unicodeOf(CodePage page, uint8_t byte);
std::string utf8From(CodePage page, std::string_view bytes);

// The byte of a character in Windows-1250; nothing when it has none there.
std::optional<uint8_t> windows1250Of(uint32_t codePoint);
// A text in UTF-8 as the memory holds it; a character that has no byte becomes `?`.
std::string memoryText(std::string_view utf8);
// A text of the memory as UTF-8.
inline std::string shownText(std::string_view bytes) { return utf8From(CodePage::Windows1250, bytes); }

} // namespace rung::nc
