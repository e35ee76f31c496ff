// The system parameters of a mnemonic file, section `%@0`: numbered lines (inventory §1.3).
#pragma once
#include <optional>

#include "frontend/dialects/fanuc/read/mnemonic.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/source.h"

namespace rung::frontend::fanuc {

inline constexpr uint32_t kCounterData = 2; // BINARY or BCD
inline constexpr uint32_t kPmcType = 4;

// The text of the line with a number, in ladder text of `data %@0 "4 TYPE"`; nothing if the file does not have it.
std::optional<Word> systemParameter(const SourceManager& sources, const MnemonicFile& file, uint32_t number);

} // namespace rung::frontend::fanuc
