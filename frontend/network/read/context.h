// Shared by all readers of one compilation: sources, diagnostics, names, and the count of steps.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>

#include "frontend/network/address.h"
#include "frontend/network/read/gaps.h"
#include "frontend/sema/symbol_table.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::frontend::network {

// A name that the program declares, or a signal that it uses.
struct UserName {
  enum class Kind : uint8_t { Symbol, Constant, Signal, Numbered };

  std::string_view name;
  SourceRange declared;
  Kind kind = Kind::Symbol;
  bool bad = false;      // its declaration was reported: uses are not
  bool isListed = false; // by addListed
  std::string_view comment;
  Address address;       // of a symbol or a signal
  std::string_view text; // of a constant, as declared; of a label or a subprogram, such as "P5"
  int64_t value = 0;     // of a constant; the number of a label or a subprogram
};

// An address in an operand.
struct NamedAddress : Address {
  uint32_t name = frontend::kNoDefinition; // the name as which it is written
};

// A use of a name that is not declared, where this kind is expected.
struct UndeclaredName : frontend::UndeclaredUse {
  UserName::Kind kind = UserName::Kind::Symbol;
  std::string expected;
};

struct Context;

class Names : public frontend::SymbolTable<UserName, UndeclaredName> {
public:
  explicit Names(const Language& language);

  void addSymbol(Context& context, const Word& name, const Word& value, std::string_view comment);
  void addConstant(Context& context, const Word& name, const Word& value);
  // A name in a table that the control's own tools have made, whatever its characters are: where it could also be an
  // address, a number or a command it is that. The same declaration may appear again.
  void addListed(Diagnostics& diagnostics, UserName name);

  bool has(std::string_view name) const { return find(name) != frontend::kNoName; }
  // The meaning of a word, recorded as a use; kNoName if the program has no name of this kind.
  uint32_t use(const Word& word, UserName::Kind kind);
  // The same for a signal's name.
  std::optional<NamedAddress> useSignal(const Language& language, const Word& word);
  // In the order of their declarations.
  auto ofKind(UserName::Kind kind) const {
    return all() | std::views::filter([kind](const UserName& name) { return name.kind == kind; });
  }
  // Adds all names to the analysis. Must be called last.
  void addTo(frontend::Analysis& analysis, const Language& language) const;

private:
  static constexpr uint32_t kSignals = 1; // scope; the program may declare a name that a signal has

  // Adds a name, bad until its value is read; null after a report.
  UserName* declare(Context& context, const Word& name, UserName::Kind kind);
};

struct Context {
  const Language& language;
  SourceManager& sources;
  Diagnostics& diagnostics;
  Names names = Names(language);
  uint32_t steps = 0;
  bool isSimulated = false; // the program runs beside the simulated CNC
  // Called with what operands name: a bit, or `length` bytes from an address on. May be empty.
  std::function<void(const Word& word, const Address& address, uint32_t length)> onPlace = {};
  Gaps gaps = {};
  frontend::Analysis analysis = {};
};

// A word that is not what the operand expects, a constant or an address, nor a name of this kind. An undeclared name is
// left to reportUndeclared, other words are reported at once.
void unknownOperand(Context& context, const Word& word, UserName::Kind kind, std::string_view expected);
// Reports names that are not declared, once each, at their first use. Must be called after all operands have been read.
void reportUndeclared(Context& context);

// Whether the first two words of a statement form one command of another language: AND NOT.
bool isForeign(const Language& language, std::span<const Word> words);
// Report the words of a statement that begins with no command, or a wrong function name in FUNC or a box, possibly with
// a suggestion. `drawn`: the meaning of a box whose name is a command's (ladder::drawnFor).
void reportUnknownCommand(Context& context, std::span<const Word> words);
void reportUnknownFunction(Context& context, std::string_view name, SourceRange range, std::string_view drawn = {});

// Counts one step of the program memory (P1); the first one that exceeds it is reported.
void countStep(Context& context, SourceRange range);

// `bytes` from the address on, or its bit, for the analysis.
frontend::NamedPlace placeOf(const Language& language, const Address& address, uint32_t bytes);

// Operands. Each function reports a mistake, or records an undeclared name, and then returns nullopt; for a name with a
// wrong declaration, or an operand without a position, which have been reported, it only returns nullopt.
std::optional<NamedAddress> bitOperand(Context& context, const Word& word);
inline constexpr std::string_view kByteAddress = "a byte address, a signal or a declared name";
std::optional<NamedAddress> byteOperand(Context& context, const Word& word, uint32_t length,
                                        std::string_view expected = kByteAddress);
// False, with a report, if the program must not write `length` bytes (a bit: 1) there; warns of the system area.
bool checkWritable(Context& context, const Address& address, uint32_t length, SourceRange range);
struct CoilTraits { // see frontend::OperandUse
  bool isSet = false;
  bool isDue = false;
};
// The operand of a contact, which reads, or of a coil, which writes; added to the analysis. Nullopt as above, and for a
// bit that the program must not write.
std::optional<Address> readBit(Context& context, const Word& word, frontend::Access access, CoilTraits coil = {});

} // namespace rung::frontend::network
