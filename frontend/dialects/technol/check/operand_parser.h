// Reads the operands of a statement.
#pragma once

#include "frontend/dialects/technol/check/typed.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"

namespace rung::frontend::technol {

// Parses the operands of one statement; reports everything that is wrong with them.
class OperandParser {
public:
  // What operands need beside themselves, names and texts, goes to `typed`.
  OperandParser(TypedProgram& typed, SymbolTable& symbols, std::string_view axisNames, Diagnostics& diagnostics)
      : program_(typed.source), declarations_(typed.declarations), symbols_(symbols), axisNames_(axisNames),
        diagnostics_(diagnostics), names_(typed.names), texts_(typed.texts) {}

  // False after a report. The operands follow in `out`, one an operand of the source and NotGiven where the row allows
  // more.
  bool parse(const Statement& statement, std::vector<Operand>& out);

private:
  // What an address expression comes to: a place in a space, or a constant.
  struct Address {
    bool hasBase = false;
    bool isBit = false; // the base is the name of a bit: its byte
    bool isText = false;
    bool indexed = false;
    bool isReal = false;
    ir::SpaceId space;
    int64_t byte = 0; // with a base: in its space; else the value
    double real = 0;
    ir::Type type = ir::Type::None;
    int64_t begin = 0; // of the base object
    int64_t end = 0;
    Protection protection = Protection::None;
    std::string_view name; // of the base
    const char* structure = "";
    uint32_t own = kNone; // the program's own structure that it is, in Declarations::structures
  };

  bool one(const OperandInfo& info, const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool waitOperands(std::span<Operand> operands);
  bool bit(const OperandInfo& info, const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool noBitName(std::span<const Token> tokens, SourceRange point);
  bool reportNegated(bool writes, const Operand& out);
  bool negatedByWord(bool mayBeNegated, bool writes, std::span<const Token> tokens, const Operand& out);
  bool bareBit(const OperandInfo& info, const OperandKind& kind, const Token& name, Operand& out);
  bool bitAt(const OperandInfo& info, std::span<const Token> where, const Token& name, Operand& out);
  bool flag(const Token& number, Operand& out);
  uint32_t bitSymbol(const Token& name);
  bool value(const OperandInfo& info, const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool constant(const OperandInfo& info, const OperandKind& kind, const Address& address, uint8_t prefix, Operand& out);
  bool cell(const OperandInfo& info, const OperandKind& kind, const Address& address, uint8_t prefix, Operand& out);
  uint8_t takePrefix(std::span<const Token>& tokens);
  bool named(const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool keyword(const OperandInfo& info, const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool misspeltPrefix(std::span<const Token> tokens);
  bool ownWord(const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool wrongPrefix(uint8_t prefix, const Operand& operand);
  bool variable(const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool exchanged(const OperandKind& kind, const Symbol& symbol, Operand& out);
  bool chosen(const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool text(const OperandInfo& info, const OperandKind& kind, std::span<const Token> tokens, Operand& out);
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
  bool syntax(std::string_view expected, std::span<const Token> tokens, SourceRange otherwise); // where there are none
  // The symbol of a name, which is noted.
  uint32_t note(const Token& name, uint32_t symbol);
  uint32_t require(const Token& name) { return note(name, symbols_.require(name, file_)); }

  const SourceProgram& program_;
  const Declarations& declarations_;
  SymbolTable& symbols_;
  std::string_view axisNames_;
  Diagnostics& diagnostics_;
  std::vector<NameUse>& names_;
  std::deque<std::string>& texts_;
  uint32_t file_ = 0;
  const Statement* statement_ = nullptr;
  uint8_t inherited_ = 0; // prefix of the operand before
};

} // namespace rung::frontend::technol
