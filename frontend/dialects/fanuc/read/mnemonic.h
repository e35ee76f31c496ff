// A mnemonic file, and its ladder, `%@3` (inventory §1.5, F6).
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "frontend/dialects/fanuc/format.h"
#include "frontend/dialects/fanuc/read/sections.h"
#include "frontend/dialects/fanuc/read/symbols.h"
#include "frontend/dialects/fanuc/write.h"
#include "frontend/network/language.h"
#include "frontend/syntax/word_lexer.h"

namespace rung::frontend::fanuc {

// Words are separated by blanks; a remark begins with ;.
inline constexpr WordRules kMnemonicRules = {.comment = ';', .quotes = "", .separators = ""};
// Whether a word is a command, in either case (F2).
bool isCommand(std::string_view word);
// `N00012:`
bool isNetworkNumber(std::string_view word);

class MnemonicFile final : public network::ListFile {
public:
  MnemonicFile(const SourceManager& sources, FileId file) : ListFile(file), sections_(sectionsOf(sources, file)) {}
  std::span<const Section> sections() const { return sections_.list; }
  bool begins() const { return sections_.begins; }
  bool ends() const { return sections_.ends; }
  // The symbols and the ladders of all sections.
  void readDeclarations(network::Context& context) const override;
  void read(network::Context& context, network::UnitAssembler& units) const override;

private:
  FileSections sections_;
};

using MnemonicFiles = std::vector<std::shared_ptr<const MnemonicFile>>;

std::shared_ptr<const network::ListFile> openMnemonic(const SourceManager& sources, FileId file);
inline constexpr network::ListForm kMnemonicForm = {.open = &openMnemonic,
                                                    .format = &formatMnemonic,
                                                    .command = &mnemonicCommand,
                                                    .commentColumn = kCommentColumn,
                                                    .blockComments = true,
                                                    .frame = &mnemonicFile,
                                                    .addSymbol = &addDrawnSymbol};

} // namespace rung::frontend::fanuc
