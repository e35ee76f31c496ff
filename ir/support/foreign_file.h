// What a file is that was given as one of a FANUC control, by its contents: the place where a wrong file is recognised,
// for the compiler and for `rungc import`.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rung {

/// Files of a FANUC control, of LADDER-III and of the PMC simulator that are not programs; `rungc import` reads them.
enum class ControlFile : uint8_t {
  Parameters, ///< PMC parameters as the control writes them: N600000 P48
  Symbols,    ///< symbols and comments as CSV: START,X0010.0,START BUTTON
  Trace,      ///< a signal trace that LADDER-III has saved as CSV
  Signals,    ///< a signal operation file of the PMC simulator
};

/// `text` is UTF-8 without byte order mark. Nothing for any other file; a file with sections (`%@3`) is a program.
std::optional<ControlFile> controlFileOf(std::string_view text);

/// Whether a text has sections of a mnemonic file, whatever its name is.
bool isMnemonicFile(std::string_view text);

/// The first control character that no text has; npos if there is none. `text` is in UTF-8.
size_t firstBinary(std::string_view text);
/// Whether the bytes, in any encoding, have such a character.
bool isBinary(std::string_view bytes);

/// What the bytes of a file are if they are not a program of a FANUC PMC, and how to get one: a text that continues
/// "this is …". Nothing for what may be a program.
std::optional<std::string> foreignFile(std::string_view bytes);

} // namespace rung
