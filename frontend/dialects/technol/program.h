// A program that has been read: its text in statements and units, and the memory of its declarations. The reader makes
// both; for check and lowering they are constant.
#pragma once

#include <deque>
#include <span>
#include <unordered_set>
#include <vector>

#include "frontend/dialects/technol/read/symbols.h"
#include "rtlib/nc/technol/exchange.h"

namespace rung::frontend::technol {

// Procedures that the control calls: when a message is generated (man. l.1609), at its commands and events
// (l.1614-1644).
inline constexpr std::string_view kOnMessage = "_ON_ESET";
inline constexpr std::string_view kOnEvents[] = {"_ON_CMD", "_ON_EVENT"};

// The text of a program.
struct SourceProgram {
  explicit SourceProgram(const SourceManager& sourceManager) : sources(sourceManager) {}

  const SourceManager& sources;
  std::vector<SourceFile> files;
  std::vector<Token> tokens;
  std::deque<std::string> madeTexts; // texts of tokens that are not in a source
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
  // The procedure that is the unit or contains it; kNone if none does.
  uint32_t procedureOf(UnitId unit) const;
  bool inMechanism(UnitId unit) const;
  // Whether statements that wait are allowed in this unit (man. l.2166-2171).
  bool mayWait(UnitId unit) const;
  // A bit for each file with such a statement.
  int64_t filesWith(bool SourceFile::* statement) const;
  // By its key; kNone if there is none.
  uint32_t procedureNamed(std::string_view name) const;
};

// A declaration that takes memory. Addresses are assigned when all constants are known, in source order over all files,
// without gaps (man. l.105).
struct DataItem {
  Role role = Role::Ds; // MemberSize: an instance of a structure
  bool local = false;   // DATA_LOCAL
  uint32_t statement = 0;
  uint32_t cell = kNone;      // index of its symbol
  std::vector<uint32_t> also; // further symbols of the same memory
  uint32_t firstBit = kNone;  // Dfm: index in Declarations::itemBits of the first of eight
  std::vector<uint8_t> image; // of an instance
  uint32_t byte = 0;          // offset in the data, once it is placed; texts over other memory take none
  uint32_t bytes = 0;
};

// A variable that MAP_* or DEF_* declares (man. ch. 10, 27), in a separate space; a bit takes a byte.
struct Exchanged {
  nc::ExchangeKind kind = nc::ExchangeKind::MapIn;
  nc::ExchangeType type = nc::ExchangeType::Bit;
  uint32_t statement = 0;
  uint32_t symbol = kNone;
  uint32_t count = 1; // number of elements, or bytes of a text
};

// The memory of a program. The names of its parts are in the Symbols.
struct Declarations {
  std::vector<DataItem> items;
  std::vector<uint32_t> itemBits; // symbols, kNone for an unnamed bit
  std::vector<StructureType> structures;
  std::unordered_set<std::string> structureNames; // keys
  std::vector<Exchanged> exchanged;
  bool exchangesFast = false; // FAST or FASTEST is requested
  std::vector<ir::Init> inits;
  uint32_t dataBytes = 0;
  uint32_t exchangedBytes = 0;
  uint32_t mechanismBytes = 0;

  // The size of one of the module's spaces.
  uint32_t bytesOf(ir::SpaceId space) const;
};

// Splits at commas outside of brackets, including those of structures; an operand may be empty. No tokens: no operands.
std::vector<std::span<const Token>> splitOperands(std::span<const Token> tokens);

// The source range of tokens; `otherwise` if there are none. For tokens that a macro made, only that of the first.
SourceRange rangeOf(const SourceManager& sources, std::span<const Token> tokens, SourceRange otherwise);

// Tokens as written, with single blanks.
std::string spelled(std::span<const Token> tokens);
// Whether a declared name is preceded by a sign, as in designations of devices: -K1. It is reported.
bool takeSign(std::span<const Token> tokens, Diagnostics& diagnostics);
// Whether tokens where a name is expected form one word, such as 1A or A-B: then the name is invalid, otherwise it is
// missing.
bool isOneWord(std::span<const Token> tokens);

} // namespace rung::frontend::technol
