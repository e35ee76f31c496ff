// The messages of a mnemonic file, section `%@4` (inventory §1.7, F7).
#pragma once
#include <optional>
#include <vector>

#include "frontend/dialects/fanuc/read/mnemonic.h"
#include "frontend/network/language.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/core/module.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend::fanuc {

// A message: it is shown while its bit of A is 1.
struct Message {
  uint32_t bit = 0;    // 8 * byte + bit
  uint32_t number = 0; // as the CNC shows it
  std::string_view text;
  SourceRange range; // of its line
};

// A line of the section: `A0.0 1000 TEXT`; nothing for one without a message.
struct MessageLine {
  Word place, text;
};
std::optional<MessageLine> messageIn(const SourceLine& line);

// All messages of the files, in their order; those of ladder text are statements, `message A0.0 "1000 TEXT"`.
std::vector<Message> readMessages(const network::Language& language, const SourceManager& sources,
                                  const MnemonicFiles& files, Diagnostics& diagnostics);

} // namespace rung::frontend::fanuc
