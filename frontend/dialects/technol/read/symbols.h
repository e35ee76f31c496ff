// Names of a program. Symbols of any case are one name, compared on 31 characters (man. l.75). Each file sees its own
// local names first (labels, DATA_LOCAL, EQUI outside DATA), then the global ones of all files, then those of the NC
// interface and the predefined constants, which are entered at their first use.
#pragma once

#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/dialects/technol/records.h"
#include "frontend/sema/analysis.h"
#include "frontend/sema/names.h"
#include "frontend/sema/undeclared.h"
#include "ir/support/diagnostics.h"
#include "ir/support/similar.h"
#include "rtlib/nc/signal.h"

namespace rung::frontend::technol {

// The module's spaces, always in this order.
inline constexpr ir::SpaceId kInterfaceSpace{0}; // "NCI"
inline constexpr ir::SpaceId kDataSpace{1};      // "DATA"
inline constexpr ir::SpaceId kMechanismSpace{2}; // "MECH": a byte with the activation bit, a word with the line
inline constexpr ir::SpaceId kRegisterSpace{3};  // "@REG": what the host gives and takes
inline constexpr ir::SpaceId kBlockSpace{4};     // "BLK": the queue of command blocks
inline constexpr ir::SpaceId kExchangeSpace{5};  // "IO": variables of MAP_* and DEF_*
inline constexpr uint32_t kQueuedBlocks = 16;
inline constexpr uint32_t kMechanismBytes = 3;
inline constexpr uint32_t kRegisterBytes = 192;
inline constexpr size_t kSignificant = 31;

// After a name that is local to one use of a macro; no program can write it.
inline constexpr char kUseMark = '#';

// Upper case, cut to what counts.
std::string symbolKey(std::string_view name);

// A constant of the control; the name in upper case.
struct Predefined {
  std::string_view name;
  int64_t value;
};
std::span<const Predefined> predefinedConstants();

class SymbolTable {
public:
  explicit SymbolTable(Diagnostics& diagnostics) : diagnostics_(diagnostics) { table_.addScope(); }

  void addFile() { table_.addScope(); }
  // Enters a name of `symbol.file` and returns its index. Reports duplicate-symbol, shared-name, reserved-word and
  // name-too-long; a duplicate gets a symbol of its own that no name leads to.
  uint32_t declare(Symbol symbol);
  // kNone where there is none.
  uint32_t find(std::string_view name, uint32_t file);
  // As find, and a use of it; where there is none, the name is noted as undefined.
  uint32_t require(const Token& name, uint32_t file);
  // While a file that was included before is read: where that is done. Gives what was said last.
  SourceRange readsAgain(SourceRange include) { return std::exchange(again_, include); }
  // What is known of a name that is not declared.
  struct Hint {
    const char* structure = nullptr; // of the control, where it is looked for as a member
    Likely meant;                    // what it may have been; without a word: to be looked for
  };
  void noteUndefined(const Token& name, uint32_t file, Hint hint);
  // Reports undefined-symbol, once for each name, at its first use.
  void reportUndefined();
  // A bit name that may only follow an address.
  uint32_t findWeight(std::string_view name, uint32_t file);
  // A member of an interface structure; kNone when it has none of this name.
  uint32_t findMember(const char* structure, std::string_view member);

  // While the program is read.
  Symbol& edit(uint32_t index) { return table_[index]; }
  const Symbol& operator[](uint32_t index) const { return table_[index]; }
  const std::deque<Symbol>& all() const { return table_.all(); }
  // Of names that were required, by the index of the symbol, in the order of asking.
  const std::vector<NameUse>& uses() const { return uses_; }

private:
  // Scopes: the global names, those of the control that are in use, and each file's own.
  static constexpr uint32_t kGlobal = 0, kControl = 1, kFirstFile = 2;
  static uint32_t scopeOf(const Symbol& symbol) { return symbol.local ? kFirstFile + symbol.file : kGlobal; }

  uint32_t inOwnFile(const Symbol& symbol) const;
  bool merge(uint32_t earlier, Symbol& symbol);
  void checkName(const Symbol& symbol);
  void checkPredeclared(const Symbol& symbol);
  uint32_t enterPredeclared(std::string_view name);
  struct Undefined : UndeclaredUse {
    uint32_t file = 0;
    Hint hint;
  };
  Likely similar(const Undefined& use) const;
  bool isMeantByAll(std::span<const Undefined> uses, std::string_view word) const;
  void reportIncludedAgain(std::string_view name);

  SourceRange again_;                 // see readsAgain
  std::set<SourcePos> reportedAgain_; // inclusions
  Diagnostics& diagnostics_;
  NameTable<Symbol, symbolKey> table_;
  std::vector<NameUse> uses_;
  std::unordered_map<const nc::Signal*, uint32_t> members_; // of structures of the control, those that are in use
  UndeclaredNames<Undefined, symbolKey> undefined_;
};

} // namespace rung::frontend::technol
