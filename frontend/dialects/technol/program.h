// A program as it has been read: its text in statements and units, and what its declarations take in memory. The reader
// makes both; for check and lowering they are constant.
#pragma once

#include <deque>
#include <span>
#include <unordered_set>
#include <vector>

#include "frontend/dialects/technol/read/symbols.h"
#include "rtlib/nc/technol/exchange.h"

namespace rung::frontend::technol {

// Procedures that the control calls: when a message comes up (man. l.1609), at its commands and events (l.1614-1644).
inline constexpr std::string_view kOnMessage = "_ON_ESET";
inline constexpr std::string_view kOnEvents[] = {"_ON_CMD", "_ON_EVENT"};

// The text of a program.
struct SourceProgram {
  explicit SourceProgram(const SourceManager& sourceManager) : sources(sourceManager) {}

  const SourceManager& sources;
  std::vector<SourceFile> files;
  std::vector<Token> tokens;
  std::deque<std::string> madeTexts; // of tokens that no source holds
  std::vector<Statement> statements;
  std::vector<Label> labels;
  std::vector<Unit> units;
  std::vector<Mechanism> mechanisms;
  std::vector<Procedure> procedures;
  std::vector<ModulePart> parts; // in the order of the sources

  const Unit& at(UnitId unit) const { return units[unit.index]; }
  std::span<const Token> operandTokens(const Statement& statement) const {
    return std::span(tokens).subspan(statement.firstToken, statement.tokenCount);
  }
  // The nearest unit that is not a timed block.
  UnitId owner(UnitId unit) const;
  // The procedure that the unit is or lies in; kNone where that is none.
  uint32_t procedureOf(UnitId unit) const;
  bool inMechanism(UnitId unit) const;
  // Whether statements that wait are allowed in this unit (man. l.2166-2171).
  bool mayWait(UnitId unit) const;
  // A bit for each file that has such a statement.
  int64_t filesWith(bool SourceFile::* statement) const;
  // By its key; kNone where there is none.
  uint32_t procedureNamed(std::string_view name) const;
};

// A declaration that takes memory. Addresses are given when all constants are known, in the order of the source over
// all files, without gaps (man. l.105).
struct DataItem {
  Role role = Role::Ds; // MemberSize: an instance of a structure
  bool local = false;   // DATA_LOCAL
  uint32_t statement = 0;
  uint32_t cell = kNone;      // symbol
  std::vector<uint32_t> also; // further symbols of the same memory
  uint32_t firstBit = kNone;  // in Declarations::itemBits, eight of them; Dfm
  std::vector<uint8_t> image; // of an instance
  uint32_t byte = 0;          // in the data, when it is placed; texts on other memory take none
  uint32_t bytes = 0;
};

// A variable that MAP_* or DEF_* declares (man. ch. 10, 27), in a space of its own; a bit has a byte of its own.
struct Exchanged {
  nc::ExchangeKind kind = nc::ExchangeKind::MapIn;
  nc::ExchangeType type = nc::ExchangeType::Bit;
  uint32_t statement = 0;
  uint32_t symbol = kNone;
  uint32_t count = 1; // elements; bytes of a text
};

// The memory of a program. The names that lead to it are in the Symbols.
struct Declarations {
  std::vector<DataItem> items;
  std::vector<uint32_t> itemBits; // symbols, kNone for an unnamed bit
  std::vector<StructureType> structures;
  std::unordered_set<std::string> structureNames; // keys
  std::vector<Exchanged> exchanged;
  bool exchangesFast = false; // FAST or FASTEST is asked for
  std::vector<ir::Init> inits;
  uint32_t dataBytes = 0;
  uint32_t exchangedBytes = 0;
  uint32_t mechanismBytes = 0;

  // The size of one of the module's spaces.
  uint32_t bytesOf(ir::SpaceId space) const;
};

// Splits at the commas outside brackets, those of structures too; an operand may be empty. No tokens: no
// operands.
std::vector<std::span<const Token>> splitOperands(std::span<const Token> tokens);

// The source range of tokens; `otherwise` when there are none. Of tokens that a macro put together only the first.
SourceRange rangeOf(const SourceManager& sources, std::span<const Token> tokens, SourceRange otherwise);

// Tokens as written, one blank where there are some.
std::string spelled(std::span<const Token> tokens);
// Whether a declared name has a sign before it, as designations of devices have: -K1. It is reported.
bool takeSign(std::span<const Token> tokens, Diagnostics& diagnostics);
// Tokens that are one word, 1A or A-B, where a name should be: that is a bad name, all else no name at all.
bool isOneWord(std::span<const Token> tokens);

} // namespace rung::frontend::technol
