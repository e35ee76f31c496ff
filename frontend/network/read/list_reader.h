// Command lists (P12): one statement a line.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "frontend/network/program.h"
#include "frontend/network/read/context.h"
#include "frontend/network/read/units.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend::network {

// What a statement of a command list (P12) is by itself, whatever its operands mean.

// Comments begin with ';', there are no quoted texts.
inline constexpr WordRules kListRules = {.comment = ';', .quotes = "", .separators = ""};
// In any case; nullopt when there is none.
std::optional<Command> findCommand(const Language& language, std::string_view name);
// The words after the step number.
std::span<const Word> statementOf(const LineWords& line);

// Whether all characters may be outside comments; one that may not is reported by checkCharacters.
bool isReadable(std::span<const Word> words);
bool checkCharacters(Diagnostics& diagnostics, std::span<const Word> words);
// Reports operands that are missing or too many; `words`: the command with them.
bool checkOperands(const Language& language, Diagnostics& diagnostics, Command command, std::span<const Word> words);
// How many a command takes.
size_t operandCount(Command command);
// Whether a word begins a comment of other languages.
bool looksLikeComment(std::string_view word);

// The `symbol` and `const` statements of a file; they hold for the whole program, so they are read before all networks.
void readListSymbols(Context& context, FileId file);
void readList(Context& context, FileId file, UnitAssembler& units);
// The last line with something on it, for errors about what is missing at the end.
SourceRange lastLineOf(const SourceManager& sources, FileId file);

} // namespace rung::frontend::network
