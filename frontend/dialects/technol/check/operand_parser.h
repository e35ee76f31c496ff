// Reads the operands of a statement.
#pragma once
#include "frontend/dialects/technol/check/typed.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"

namespace rung::frontend::technol {

// Parses the operands of one statement; reports all mistakes in them.
class OperandParser {
public:
  // The texts of operands are stored in `typed`.
  OperandParser(TypedProgram& typed, Symbols& symbols, std::string_view axisNames, Diagnostics& diagnostics)
      : program_(typed.source), declarations_(typed.declarations), symbols_(symbols), axisNames_(axisNames),
        diagnostics_(diagnostics), texts_(typed.texts) {}

  // False after a report. The operands are appended to `out`, one per operand of the source, and NotGiven for those
  // that are left out.
  bool parse(const Statement& statement, std::vector<Operand>& out);

private:
  // The value of an address expression: a place in a space, or a constant.
  struct Address {
    bool hasBase = false;
    bool isBit = false; // the base is the name of a bit and means its byte
    bool isText = false;
    bool indexed = false;
    bool isReal = false;
    ir::SpaceId space;
    int64_t byte = 0; // with a base: offset in its space; otherwise the value
    double real = 0;
    ir::Type type = ir::Type::None;
    int64_t begin = 0; // offset of the base object
    int64_t end = 0;
    Protection protection = Protection::None;
    std::string_view name; // of the base
    const char* structure = "";
    uint32_t own = kNone; // its structure, if the program defines it: index in Declarations::structures
  };

  bool one(const OperandInfo& info, std::span<const Token> tokens, Operand& out);
  bool waitOperands(std::span<Operand> operands);
  // One overload for each alternative of Takes; `tokens` is not empty.
  using Tokens = std::span<const Token>;
  bool read(const BitKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const NumberKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const MemoryKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const NameKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const WordKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const MemberKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const WidthKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const RegisterKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const NewVariableKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const InputKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const BitNumberKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);
  bool read(const DeclarationKind& kind, const OperandInfo& info, Tokens tokens, Operand& out);

  bool noBitName(std::span<const Token> tokens, SourceRange point);
  bool reportNegated(bool writes, const Operand& out);
  bool negatedByWord(bool mayBeNegated, bool writes, std::span<const Token> tokens, const Operand& out);
  bool bareBit(const BitKind& kind, const OperandInfo& info, const Token& name, Operand& out);
  bool bitAt(const OperandInfo& info, std::span<const Token> where, const Token& name, Operand& out);
  bool flag(const Token& number, Operand& out);
  uint32_t bitSymbol(const Token& name);
  bool constant(const NumberKind& kind, const OperandInfo& info, const Address& address, uint8_t prefix, Operand& out);
  bool cell(const NumberKind& kind, const OperandInfo& info, const Address& address, uint8_t prefix, Operand& out);
  bool inRange(int64_t value, int64_t least, int64_t most, SourceRange at);
  uint8_t takePrefix(std::span<const Token>& tokens);
  bool misspeltPrefix(std::span<const Token> tokens);
  bool ownWord(const NumberKind& kind, std::span<const Token> tokens, Operand& out);
  bool noWord(std::string_view words, const OperandInfo& info, std::span<const Token> tokens, const Operand& out);
  bool wrongPrefix(uint8_t prefix, const Operand& operand);
  bool literal(const Token& text, Operand& out);
  bool isVariable(const OperandInfo& info, bool mayBeIndexed, std::span<const Token> tokens, const Operand& out);
  bool exchanged(const Symbol& symbol, Operand& out);
  bool block(const OperandInfo& info, std::span<const Token> tokens, bool wantsBit, Operand& out);
  bool address(std::span<const Token> tokens, Address& out);
  bool term(std::span<const Token> tokens, int sign, Address& out);
  bool addSymbol(const Token& name, int sign, Address& out);
  bool addMember(const Token& member, Address& out);
  bool addPacketMember(const Token& member, Address& out);
  bool addOwnMember(const Token& member, Address& out);
  static bool leavesItsCell(const Address& address, int64_t byte, uint32_t bytes);
  bool setPlace(const Address& address, int64_t byte, uint32_t bytes, Operand& out);
  bool checkWrite(const OperandInfo& info, Protection protection, std::string_view name, SourceRange range);
  bool wrongKind(const Operand& operand, std::string_view is, std::string_view wanted) {
    return reportWrongKind(diagnostics_, operand, is, wanted);
  }
  bool syntax(std::string_view expected, std::span<const Token> tokens);
  bool syntax(std::string_view expected, std::span<const Token> tokens, SourceRange otherwise); // for no tokens
  // Null if there is none, or its declaration has an error, which has been reported.
  const Symbol* usable(uint32_t index) const;
  // The symbol of a name; records the use.
  uint32_t note(const Token& name, uint32_t symbol);
  uint32_t require(const Token& name) { return symbols_.require(name, file_); }

  const SourceProgram& program_;
  const Declarations& declarations_;
  Symbols& symbols_;
  std::string_view axisNames_;
  Diagnostics& diagnostics_;
  std::deque<std::string>& texts_;
  uint32_t file_ = 0;
  const Statement* statement_ = nullptr;
  uint8_t inherited_ = 0; // prefix of the operand before
};

} // namespace rung::frontend::technol
