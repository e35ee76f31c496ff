// The records of a program that has been read: statements, units, symbols. Plain data with indices into the vectors of
// SourceProgram and Declarations (program.h).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dialects/technol/read/lexer.h"
#include "frontend/dialects/technol/rows/instructions.h"
#include "ir/core/builder.h"
#include "ir/core/module.h"
#include "ir/support/ids.h"

namespace rung::frontend::technol {

inline constexpr uint32_t kNone = UINT32_MAX;

using UnitId = Id<struct UnitTag>; // in SourceProgram::units

struct Statement {
  const Row* row = nullptr; // null: the line has only a label, or has an error
  SourcePos pos;            // of the mnemonic, otherwise of the label
  uint32_t length = 0;      // of the mnemonic
  uint32_t line = 0;
  uint32_t firstToken = 0; // index of the first operand token
  uint32_t tokenCount = 0;
  uint32_t label = kNone; // in SourceProgram::labels
  UnitId unit;            // innermost
  uint32_t file = 0;      // in SourceProgram::files

  SourceRange range() const { return {pos, {pos.value + length}}; }
};

// A part of a program that control enters and leaves only by its own rules.
enum class UnitKind : uint8_t { Module, Mechanism, Procedure, Timed };

struct Unit {
  UnitKind kind = UnitKind::Module;
  ModuleKind module = ModuleKind::Main;
  UnitId parent;
  uint32_t index = kNone;    // in mechanisms or procedures
  std::string_view name;     // as written
  uint32_t endLabel = kNone; // Timed
  SourceRange begin;         // of the statement that opens it
};

struct Label {
  std::string_view name;
  UnitId unit;
  uint32_t statement = 0;
  uint32_t passed = 0; // number of EX-kind statements and jumps before it
};

struct Mechanism {
  std::string_view name;
  UnitId unit;
  bool hasTimers = false; // has TIM or TEX: initialising it clears more than the continuation
};

struct Procedure {
  std::string_view name;
  UnitId unit;
};

// The part of a module in one file.
struct ModulePart {
  ModuleKind kind = ModuleKind::Main;
  uint32_t file = 0;
  UnitId unit;
  uint32_t firstStatement = 0;
  uint32_t endStatement = 0;
  SourceRange end; // of the statement that closes it
  uint32_t endLine = 0;
  bool cut = false; // the file ends inside it
};

enum class SymbolKind : uint8_t { Bit, Cell, Text, Constant, Label, Procedure, Mechanism, Macro, Structure };
// A member of a structure that the program defines.
struct StructureMember {
  std::string key; // empty: unnamed
  uint32_t offset = 0;
  uint32_t bytes = 0;
  uint32_t elementBytes = 0;  // same as `bytes`, except for an array
  uint32_t structure = kNone; // of each element, in Declarations::structures
};

struct StructureType {
  std::vector<StructureMember> members; // in source order, without gaps
  std::vector<uint8_t> image;           // initial contents of an instance
};

// Protection of interface cells, see §4.1 of the inventory.
enum class Protection : uint8_t { None, Warn, Error };

struct Symbol {
  std::string_view name; // as written at its declaration
  SymbolKind kind = SymbolKind::Cell;
  Protection protection = Protection::None;
  bool predeclared = false;
  bool local = false;
  bool isOverlay = false;         // a text over memory that has another name
  bool broken = false;            // declared with an error: uses are not reported
  ir::Type type = ir::Type::None; // of a cell; None: needs a prefix
  ir::SpaceId space;
  uint32_t byte = 0;
  uint32_t bit = 0;
  uint32_t size = 0;          // bytes of a cell or a text
  int64_t value = 0;          // of a constant
  uint32_t index = kNone;     // of a label, procedure, mechanism; of a structure or a cell of one: in structures
  uint32_t mechanism = kNone; // of a cell: the mechanism of the same name
  uint32_t exchanged = kNone; // of a variable of MAP_* or DEF_*: in Declarations::exchanged
  const char* structure = ""; // of an interface cell: the structure with its members
  uint32_t file = 0;
  SourceRange declared;
};

// A symbol with its name, kind and scope; the caller sets the rest.
inline Symbol namedSymbol(const Token& name, SymbolKind kind, uint32_t file, bool local) {
  Symbol symbol;
  symbol.name = name.text;
  symbol.kind = kind;
  symbol.local = local;
  symbol.file = file;
  symbol.declared = name.range();
  return symbol;
}

// A description for messages: "a WORD".
std::string_view describe(ir::Type type);
std::string_view describe(const Symbol& symbol);

struct SourceFile {
  FileId id;
  bool main = false;
  uint32_t lineCount = 0;
  SourceRange lastLine; // its text, for reports of what is missing at the end
  bool finishesInit = false;
  bool finishesDone = false;
};

} // namespace rung::frontend::technol
