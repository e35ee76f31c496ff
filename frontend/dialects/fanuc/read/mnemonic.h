// The ladder of a mnemonic file, `%@3` (inventory §1.5, F6).
#pragma once
#include "frontend/dialects/fanuc/format.h"
#include "frontend/network/language.h"
#include "frontend/syntax/word_lexer.h"

namespace rung::frontend::fanuc {

// Words are separated by blanks; a remark begins with ;.
inline constexpr WordRules kMnemonicRules = {.comment = ';', .quotes = "", .separators = ""};
// Whether a word is a command, in either case (F2).
bool isCommand(std::string_view word);
// `N00012:`
bool isNetworkNumber(std::string_view word);

// Reads the symbols and ladders of all sections of a file.
void readDeclarations(network::Context& context, FileId file);
void readLadders(network::Context& context, FileId file, network::UnitAssembler& units);
inline constexpr network::ListForm kMnemonicForm = {&readDeclarations, &readLadders, &formatMnemonic};

} // namespace rung::frontend::fanuc
