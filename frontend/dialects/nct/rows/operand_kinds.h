// The kinds of operands of the rows. A new kind is one descriptor here, and the rows that refer to it.
#pragma once
#include "frontend/dialects/nct/read/symbols.h"
#include "frontend/table/instruction.h"

namespace rung::frontend::nct {

// How the word of an operand is parsed.
enum class OperandClass : uint8_t { Value, Label, Scope, Text };

// Properties that the check of an operand uses, mostly for OperandClass::Value.
struct OperandTraits {
  OperandClass parse = OperandClass::Value;
  Form form = Form::Word;       // of a place: Word or Bit; Constant: no place is allowed
  uint32_t words = 1;           // of a place
  bool userMemory = false;      // the place must be in the user memory
  uint8_t constants = 0;        // allowed constants: bits of ConstantKind
  std::string_view wanted = {}; // if constants are allowed: what is expected, in the words of a message
};

struct OperandKind : frontend::OperandKindInfo, OperandTraits {};

inline const OperandKind& kindOf(const frontend::OperandInfo& operand) {
  return static_cast<const OperandKind&>(*operand.kind);
}
constexpr uint8_t setOf(ConstantKind kind) { return static_cast<uint8_t>(1 << static_cast<int>(kind)); }

namespace kinds {

inline constexpr OperandKind kBit{{"bit",
                                   "A bit: 0056.17, a bit symbol, 0056:REG (the bit's number in a register), each with "
                                   ",#3 or ,REG to move by whole words.",
                                   "7000.05", "7000", "symbol-kind-mismatch"},
                                  {.form = Form::Bit}};
inline constexpr OperandKind kWord{
    {"word", "A double word: 0056, a word symbol, with ,#3 or ,REG.", "7000", "#5", "operand-not-register"}, {}};
inline constexpr OperandKind kUserWord{
    {"uword", "A double word of the user memory, from PLCNVRAM on.", "7000", "2000", "user-area-required"},
    {.userMemory = true}};
inline constexpr OperandKind kDouble{
    {"double", "The first of two words of a double; an index is even.", "7000", "9999", "double-at-9999"},
    {.words = 2}};
inline constexpr OperandKind kUserDouble{
    {"udouble", "The first of two words of a double in user memory.", "7000", "2000", "user-area-required"},
    {.words = 2, .userMemory = true}};
inline constexpr OperandKind kInteger{{"int", "#14, #-25, #$FF or a word.", "#-25", "*1.5", "operand-type-mismatch"},
                                      {.constants = setOf(ConstantKind::Decimal) | setOf(ConstantKind::Hex),
                                       .wanted = "#decimal, #$hexadecimal or a word"}};
inline constexpr OperandKind kDecimal{{"dec", "#14 or a word.", "#14", "#$FF", "operand-type-mismatch"},
                                      {.constants = setOf(ConstantKind::Decimal), .wanted = "#decimal or a word"}};
inline constexpr OperandKind kHex{{"hex", "#$FF or a word.", "#$FF", "#14", "operand-type-mismatch"},
                                  {.constants = setOf(ConstantKind::Hex), .wanted = "#$hexadecimal or a word"}};
inline constexpr OperandKind kFloat{
    {"float", "*3.5 or a double.", "*3.5", "#3", "operand-type-mismatch"},
    {.words = 2, .constants = setOf(ConstantKind::Real), .wanted = "*floating-point or a double"}};
inline constexpr OperandKind kLabel{{"label", "#0 to #99.", "#5", "#100", "label-out-of-range"},
                                    {.parse = OperandClass::Label}};
inline constexpr OperandKind kScope{
    {"scope", "The name of a quantity of the NC.", "ActPosAx", "ActPosXx", "unknown-scope-symbol"},
    {.parse = OperandClass::Scope}};
inline constexpr OperandKind kText{{"text", "A text in quotes.", "\"Spindle\""}, {.parse = OperandClass::Text}};

} // namespace kinds

} // namespace rung::frontend::nct
