// Operands of executable statements: what a row may ask for (a kind) and what a program wrote.
#pragma once

#include <span>
#include <string_view>

#include "frontend/dialects/technol/program.h"

namespace rung::frontend::technol {

struct Operand {
  enum class Form : uint8_t {
    NotGiven,
    Bit,
    Cell,
    Text,
    Integer,
    Real,
    Label,
    Mechanism,
    Procedure,
    Width,
    Register,
    Keyword // value: its place among OperandKind::keywords
  };

  Form form = Form::NotGiven;
  bool negated = false;           // a bit or a value with `-`
  bool indexed = false;           // register BX is added to the address
  bool prefixed = false;          // the type was written
  uint32_t scale = 1;             // bytes that BX counts
  ir::Type type = ir::Type::None; // of a cell, a constant or a width; F64 for reals
  ir::Place place;
  // Of a text or an array at an address: bytes from there to its end, with a text's terminator; 0 past the end. Where
  // indexed, from `value` on: BX takes off more.
  uint32_t size = 0;
  int64_t begin = 0; // of that text or array, in its space
  int64_t end = 0;
  int64_t value = 0; // of a constant; where indexed, the offset in bytes that BX is added to
  double real = 0;
  uint32_t index = kNone; // label, mechanism, procedure, variable of MAP_* or DEF_*
  std::string_view text;  // of a quoted text, as the memory holds it (Windows-1250)
  std::span<const Token> tokens;
  SourceRange range;

  bool given() const { return form != Form::NotGiven; }
  bool isConstant() const { return form == Form::Integer || form == Form::Real; }
  bool isReal() const { return type == ir::Type::F64; }
};

// Which type prefixes a kind takes.
enum Prefix : uint8_t { kByte = 1, kWord = 2, kDword = 4, kQword = 8, kHigh = 16, kReal = 32, kCnst = 64 };

enum class OperandClass : uint8_t { Bit, Value, Label, Name, Keyword, Text, Variable };

struct OperandKind {
  OperandKindInfo info;
  OperandClass parse = OperandClass::Value;
  uint8_t prefixes = 0;
  bool sign = false;                   // `-` in front
  bool cell = true;                    // a cell may stand there
  bool constant = false;               // a constant may
  bool notGiven = false;               // `-` or NIL may
  bool empty = false;                  // nothing may, between commas
  bool text = false;                   // a text may
  bool weight = false;                 // a bit number without an address may: its place has no space
  uint8_t types = 0xFF;                // ir::TypeSet of cells
  SymbolKind name = SymbolKind::Label; // class Name
  std::string_view keywords = {};      // parted by blanks; beside what else may stand there
  const char* structure = nullptr;     // of the control: class Keyword, one of its members
};

std::span<const OperandKind> operandKinds();
std::span<const OperandKindInfo> operandKindInfos();
// By its name; null when there is none.
const OperandKind* findOperandKind(std::string_view kind);

// The classes that name variables of MAP_* and DEF_*, and a bit for its number.
inline constexpr std::string_view kNewBit = "new bit";
inline constexpr std::string_view kNewReal = "new real";
inline constexpr std::string_view kNewVariable = "new variable";
inline constexpr std::string_view kLogicalInput = "logical input";
inline constexpr std::string_view kBitName = "name of a bit";

// Parses the operands of one statement; reports everything that is wrong with them.
class OperandParser {
public:
  // `spaceBytes` are the sizes of the module's spaces, for constant addresses.
  OperandParser(Program& program, std::span<const uint32_t> spaceBytes) : program_(program), spaceBytes_(spaceBytes) {}

  // False after a report. The operands stand in `out`, one an operand of the source and NotGiven where the row allows
  // more.
  bool parse(const Statement& statement, std::vector<Operand>& out);
  // The operand as written, without blanks.
  static std::string spell(const Operand& operand);
  // False: the report is wrong-operand-kind.
  static bool wrongKind(Program& program, const Operand& operand, std::string_view is, std::string_view wanted);

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
    uint32_t own = kNone; // the program's own structure that it is, in Program::structures
  };

  bool countFits(const Statement& statement, size_t found);
  bool one(const OperandInfo& info, const OperandKind& kind, std::span<const Token> tokens, Operand& out);
  bool waitOperands(std::span<Operand> operands);
  bool bit(const OperandInfo& info, const OperandKind& kind, std::span<const Token> tokens, Operand& out);
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
  bool addOwnMember(const Token& member, Address& out);
  bool setPlace(const Address& address, int64_t byte, uint32_t bytes, Operand& out);
  bool checkWrite(const OperandInfo& info, Protection protection, std::string_view name, SourceRange range);
  bool wrongKind(const Operand& operand, std::string_view is, std::string_view wanted) {
    return wrongKind(program_, operand, is, wanted);
  }
  bool syntax(std::string_view expected, std::span<const Token> tokens);

  Program& program_;
  std::span<const uint32_t> spaceBytes_;
  uint32_t file_ = 0;
  const Statement* statement_ = nullptr;
  uint8_t inherited_ = 0; // prefix of the operand before
};

} // namespace rung::frontend::technol
