// Reads command lists (P12): one statement per line.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "frontend/network/format.h"
#include "frontend/network/program.h"
#include "frontend/network/read/context.h"
#include "frontend/network/read/units.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend::network {

// Statements of a command list (P12), independently of the meaning of their operands.

// Comments begin with ';', there are no quoted texts.
inline constexpr WordRules kListRules = {.comment = ';', .quotes = "", .separators = ""};
// Ignoring case; nullopt for any other word.
std::optional<Command> findCommand(const Language& language, std::string_view name);
// The words after the step number.
std::span<const Word> statementOf(const LineWords& line);

// Whether all characters are allowed outside of comments; checkCharacters reports one that is not.
bool isReadable(std::span<const Word> words);
bool checkCharacters(Diagnostics& diagnostics, std::span<const Word> words);
// Reports missing or surplus operands; `words`: the command with its operands.
bool checkOperands(const Language& language, Diagnostics& diagnostics, Command command, std::span<const Word> words);
// The number of operands of a command.
size_t operandCount(Command command);
// Whether a word begins a comment of other languages.
bool looksLikeComment(std::string_view word);

std::shared_ptr<const ListFile> openList(const SourceManager& sources, FileId file);
inline constexpr ListForm kCommandList = {
    .open = &openList, .format = &formatList, .command = &listCommand, .commentColumn = kCommentColumn};
// The last line that is not blank, for reports of what is missing at the end.
SourceRange lastLineOf(const SourceManager& sources, FileId file);

} // namespace rung::frontend::network
