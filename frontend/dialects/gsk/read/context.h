// What all readers of one compilation share: sources, diagnostics, names, and the count of steps.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dialects/gsk/read/address.h"
#include "frontend/dialects/gsk/read/signals.h"
#include "frontend/sema/analysis.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::gsk {

struct UserSymbol {
  std::string name;
  std::string comment;
  Address address;
  bool bad = false; // its declaration was reported: uses stay silent
  SourceRange range;
  uint32_t definition = 0; // in the analysis
};

struct UserConstant {
  int64_t value = 0;
  bool bad = false;
  uint32_t definition = 0; // in the analysis
};

// An address as an operand has it.
struct NamedAddress : Address {
  uint32_t name = frontend::kNoDefinition; // that it is written as
};

struct Context;

class Names {
public:
  void addSymbol(Context& context, const Word& name, const Word& value, std::string_view comment);
  void addConstant(Context& context, const Word& name, const Word& value);

  // What a word means, which the analysis has as a use of it then; null for no name of the program.
  const UserSymbol* useSymbol(frontend::Analysis& analysis, const Word& word) const;
  const UserConstant* useConstant(frontend::Analysis& analysis, const Word& word) const;
  // The same of a signal's name.
  std::optional<NamedAddress> useSignal(frontend::Analysis& analysis, const Word& word);
  const std::vector<UserSymbol>& symbols() const { return symbols_; }

private:
  bool declare(Diagnostics& diagnostics, const Word& name);

  std::vector<UserSymbol> symbols_;
  std::map<std::string, uint32_t, std::less<>> symbolByName_;
  std::map<std::string, UserConstant, std::less<>> constants_;
  std::map<std::string, SourceRange, std::less<>> declared_;
  std::map<const nc::Signal*, uint32_t> signals_; // those that are used: their definitions
};

// The manual's program memory (man. l.354).
inline constexpr uint32_t kMaxSteps = 12000;

struct Network;

struct Context {
  SourceManager& sources;
  Diagnostics& diagnostics;
  Names names = {};
  uint32_t steps = 0;
  Machine machine = Machine::Any;
  // May be empty. Takes every complete network with what was written.
  std::function<void(const Network&)> onNetwork = {};
  frontend::Analysis analysis = {};
};

// Reports a word in place of a command, and a function that FUNC or a box names wrongly; with what was meant, perhaps.
void reportUnknownCommand(Context& context, const Word& word, std::span<const std::string_view> commands);
void reportUnknownFunction(Context& context, std::string_view name, SourceRange range);

// One step of the program memory more (P1); the one that is too much is reported.
void countStep(Context& context, SourceRange range);

// `bytes` from the address on, or its bit, as the analysis has it.
frontend::NamedPlace placeOf(const Address& address, uint32_t bytes);

// Operands. Each reports what is wrong and gives nullopt then; a name whose declaration is wrong, or an operand without
// a place, gives nullopt silently: it was reported.
std::optional<NamedAddress> bitOperand(Context& context, const Word& word);
std::optional<NamedAddress> byteOperand(Context& context, const Word& word, uint32_t length);
// False, with a report, when the program may not write `length` bytes (a bit: 1) there; warns of the system area.
bool checkWritable(Context& context, const Address& address, uint32_t length, SourceRange range);
// The operand of a contact, which reads, or of a coil, which writes; the analysis has it then. Nullopt as above, and
// for a bit that the program may not write.
std::optional<Address> readBit(Context& context, const Word& word, frontend::Access access);

} // namespace rung::gsk
