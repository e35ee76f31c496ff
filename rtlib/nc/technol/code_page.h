// The character sets of Czech sources. The control keeps a character in one byte; here a program's memory holds
// Windows-1250, and everything outside of it (sources, messages, scenarios) is UTF-8.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rung::nc {

enum class CodePage : uint8_t { Windows1250, Cp852 };

// Guesses the code page of a Czech text by its letters; Windows-1250 if they do not decide it.
CodePage guessCodePage(std::string_view text);

// The character of a byte. Bytes that the code page leaves undefined keep their number.
uint32_t unicodeOf(CodePage page, uint8_t byte);
std::string utf8From(CodePage page, std::string_view bytes);

// The byte of a character in Windows-1250; nothing if there is none.
std::optional<uint8_t> windows1250Of(uint32_t codePoint);
// Converts a UTF-8 text to its form in memory; a character without a byte becomes `?`.
std::string memoryText(std::string_view utf8);
// Converts a text of the memory to UTF-8.
inline std::string shownText(std::string_view bytes) { return utf8From(CodePage::Windows1250, bytes); }

} // namespace rung::nc
