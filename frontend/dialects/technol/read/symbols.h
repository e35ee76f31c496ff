// Names of a program, compared without case on 31 characters (man. l.75). Each file sees its own local names first
// (labels, DATA_LOCAL, EQUI outside DATA), then the global ones of all files, then those of the NC interface and the
// predefined constants, which are added on first use.
#pragma once
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/dialects/technol/records.h"
#include "frontend/sema/symbol_table.h"
#include "rtlib/nc/signal.h"
#include "rtlib/text/similar.h"

namespace rung::frontend::technol {

// The module's spaces, always in this order.
inline constexpr ir::SpaceId kInterfaceSpace{0}; // "NCI"
inline constexpr ir::SpaceId kDataSpace{1};      // "DATA"
inline constexpr ir::SpaceId kMechanismSpace{2}; // "MECH": a byte with the activation bit, a word with the line
inline constexpr ir::SpaceId kRegisterSpace{3};  // "@REG": cells shared with the host
inline constexpr ir::SpaceId kBlockSpace{4};     // "BLK": the queue of command blocks
inline constexpr ir::SpaceId kExchangeSpace{5};  // "IO": variables of MAP_* and DEF_*
inline constexpr uint32_t kQueuedBlocks = 16;
inline constexpr uint32_t kMechanismBytes = 3;
inline constexpr uint32_t kRegisterBytes = 192;
inline constexpr size_t kSignificant = 31;

// Follows a name that is local to one use of a macro; it cannot be written in a program.
inline constexpr char kUseMark = '#';

// In upper case, shortened to the significant characters.
std::string symbolKey(std::string_view name);

// A constant of the control, with its name in upper case.
struct Predefined {
  std::string_view name;
  int64_t value;
};
std::span<const Predefined> predefinedConstants();

// Hints about a name that is not declared.
struct NameHint {
  const char* structure = nullptr; // a structure of the control in which it is looked up as a member
  text::Likely meant;              // a suggestion; without a word: to be looked for
  bool isBit = false;              // it is used as a bit
};

struct UndefinedName : UndeclaredUse {
  uint32_t file = 0;
  NameHint hint;
};

class Symbols : public SymbolTable<Symbol, UndefinedName> {
public:
  explicit Symbols(Diagnostics& diagnostics) : SymbolTable(symbolKey), diagnostics_(diagnostics) { addScope(); }

  void addFile() { addScope(); }
  // Adds a name of `symbol.file` and returns its index. Reports duplicate-symbol, shared-name, reserved-word and
  // name-too-long; a duplicate gets a separate symbol that cannot be found by name.
  uint32_t declare(Symbol symbol);
  // Sets the position of the include while an already included file is read again. Returns the former value.
  SourceRange readsAgain(SourceRange include) { return std::exchange(again_, include); }
  using SymbolTable::edit; // while the program is read

  // kNone if there is none.
  uint32_t find(std::string_view name, uint32_t file);
  // Like find, and records a use; an unknown name is recorded as undefined.
  uint32_t require(const Token& name, uint32_t file);
  // A bit name that may only follow an address.
  uint32_t findWeight(std::string_view name, uint32_t file);
  // A member of an interface structure; kNone if it has no member of this name.
  uint32_t findMember(const char* structure, std::string_view member);
  void noteUndefined(const Token& name, uint32_t file, NameHint hint) {
    noteUndeclared({{name.text, name.range()}, file, hint});
  }
  // Reports undefined-symbol. Must be called after all operands have been read.
  void reportUndefined();

private:
  // Scopes: the global names, those of the control that are in use, and the local names of each file.
  static constexpr uint32_t kGlobal = 0, kControl = 1, kFirstFile = 2;
  static uint32_t scopeOf(const Symbol& symbol) { return symbol.local ? kFirstFile + symbol.file : kGlobal; }

  uint32_t inOwnFile(const Symbol& symbol) const;
  bool merge(uint32_t earlier, Symbol& symbol);
  void checkName(const Symbol& symbol);
  void checkPredeclared(const Symbol& symbol);
  uint32_t enterPredeclared(std::string_view name);
  text::Likely similar(const UndefinedName& use) const;
  bool isMeantByAll(std::span<const UndefinedName> uses, std::string_view word) const;
  void reportIncludedAgain(std::string_view name);

  SourceRange again_;                 // see readsAgain
  std::set<SourcePos> reportedAgain_; // inclusions
  Diagnostics& diagnostics_;
  std::unordered_map<const nc::Signal*, uint32_t> members_; // members of control structures that are in use
};

// Constant expressions: numbers, characters, constants and members, combined by + and -.

// Reads the constant expressions of one file.
class ConstantReader {
public:
  ConstantReader(Symbols& symbols, Diagnostics& diagnostics, uint32_t file)
      : symbols_(symbols), diagnostics_(diagnostics), file_(file) {}

  // Nothing after a report; `otherwise` is its range if there are no tokens.
  std::optional<int64_t> value(std::span<const Token> tokens, SourceRange otherwise);

private:
  std::optional<int64_t> term(const Token& token);
  std::optional<int64_t> named(const Token& name);
  std::optional<int64_t> syntax(SourceRange at, const std::string& found);
  std::optional<int64_t> badNumber(const Token& token);

  Symbols& symbols_;
  Diagnostics& diagnostics_;
  uint32_t file_;
};

} // namespace rung::frontend::technol
