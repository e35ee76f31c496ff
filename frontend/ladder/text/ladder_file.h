// Ladder text as data: the contents of a `*.lad` file of any dialect. Its drawings are rungs (frontend/ladder/rung.h),
// whose elements are in text order, the upper line first, then the left one. All texts are views into the
// SourceManager's buffers.
#pragma once

#include <string_view>
#include <vector>

#include "frontend/ladder/rung.h"
#include "frontend/table/instruction.h"

namespace rung::frontend::ladder {

/// `module WORDS`, e.g. "MAIN" or "SUB" "P1".
struct Module {
  std::vector<Word> name; ///< at least one word
  SourceRange range;
};

enum class DeclarationKind : uint8_t { Symbol, Const, Message, Button, Data };
constexpr bool holdsText(DeclarationKind kind) { return kind >= DeclarationKind::Message; }

/// `symbol NAME VALUE`, `const NAME VALUE`, `message NUMBER "text"`, `button NUMBER "text"`, `data SECTION "line"`.
struct Declaration {
  DeclarationKind kind = DeclarationKind::Symbol;
  Word name;  ///< for a message or button, its number; for data, the section
  Word value; ///< quoted for texts, never for others
  std::string_view comment;
  SourceRange range;
};

struct Section {
  Word title;
  SourceRange range;
};

/// Comment and Blank: lines outside of drawings.
enum class StatementKind : uint8_t { Dialect, Module, Declaration, Section, Rung, Comment, Blank };

/// The contents of a file, in order; index is that in the vector of their kind, 0 if there is none.
struct Statement {
  StatementKind kind;
  uint32_t index = 0;
  uint32_t line = 0;
  std::string_view comment = {}; ///< the comment on the same line
};

struct LadderFile {
  FileId file;
  std::string_view dialect; ///< empty if the statement is missing (reported)
  SourceRange dialectRange;
  std::vector<Statement> statements;
  std::vector<Module> modules;
  std::vector<Declaration> declarations;
  std::vector<Word> badNames; ///< names of declarations that were reported: uses of them should not be reported
  std::vector<Section> sections;
  std::vector<Rung> rungs;
  std::vector<Comment> comments; ///< comments that are statements
};

/// The row of a box's mnemonic in the dialect's table; null if the dialect has none. The drawing alone cannot
/// distinguish `{R }` below `{CNT …}`, a pin, from `{RET}` below `{MOV …}`, another box.
using FindBox = const frontend::InstructionInfo* (*)(std::string_view mnemonic);

/// Parses a file. Mistakes are reported, and parsing continues with the next statement. Without findBox (or for a
/// mnemonic unknown to it) every box of one word that is exactly below a box is a pin of that box.
LadderFile parseLadder(const SourceManager& sources, FileId file, Diagnostics& diagnostics, FindBox findBox = nullptr);

/// The first word of each box in the text of an Error, which it might have been.
std::vector<std::string_view> boxWords(std::string_view drawing);

/// The name after `dialect`, if that is the first statement of the text; otherwise empty. Reports nothing.
std::string_view peekDialect(const SourceManager& sources, FileId file);

} // namespace rung::frontend::ladder
