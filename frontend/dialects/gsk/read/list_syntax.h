// What a statement of a command list, `*.pmc` (P12), is by itself, whatever its operands mean.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "frontend/dialects/gsk/program.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diagnostics.h"

namespace rung::gsk {

// Comments begin with ';', there are no quoted texts.
inline constexpr WordRules kListRules = {.comment = ';', .quotes = "", .separators = ""};
// In any case; nullopt when there is none.
std::optional<Command> findCommand(std::string_view name);
constexpr bool isDeclaration(Command command) { return command == Command::Symbol || command == Command::Const; }
// The words after the step number.
std::span<const Word> statementOf(const LineWords& line);

// Whether all characters may be outside comments; one that may not is reported by checkCharacters.
bool isReadable(std::span<const Word> words);
bool checkCharacters(Diagnostics& diagnostics, std::span<const Word> words);
// Reports operands that are missing or too many; `words`: the command with them.
bool checkOperands(Diagnostics& diagnostics, Command command, std::span<const Word> words);

} // namespace rung::gsk
