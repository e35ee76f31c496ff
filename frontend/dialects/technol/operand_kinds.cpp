// The classes of operands: what may be written for each, for the parser, the reference and generated tests.
#include <array>

#include "frontend/dialects/technol/operand.h"

namespace rung::frontend::technol {
namespace {

using C = OperandClass;

constexpr uint8_t kCells = kByte | kWord | kHigh | kDword | kReal | kQword;
constexpr ir::TypeSet kShort = ir::setOf(ir::Type::I8) | ir::setOf(ir::Type::I16);

constexpr OperandKind kKinds[] = {
    {.info = {.kind = "bit", .doc = "A bit, also negated or at an address: `ALFA`, `-ALFA`, `BUN5.ALFA`, `(BUN5+3).ALFA`, `$+1.ALFA`, `BUN5[BX].ALFA`, `BLK[0].M3`.",
              .good = "BIT0", .bad = "CELL1", .badCode = "wrong-operand-kind"},
     .parse = C::Bit, .sign = true},
    {.info = {.kind = "plain bit", .doc = "A bit without a sign, also at an address.", .good = "BIT0", .bad = "-BIT0", .badCode = "wrong-operand-kind"},
     .parse = C::Bit},
    {.info = {.kind = "flag", .doc = "0 or 1.", .good = "1", .bad = "2", .badCode = "operand-range"}, .cell = false, .constant = true},
    {.info = {.kind = "signed value", .doc = "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL., or a constant (32 bits, or a real with a decimal point); `-` takes it negative.",
              .good = "CELL1", .bad = "BIT0", .badCode = "wrong-operand-kind"},
     .prefixes = kCells | kCnst, .sign = true, .constant = true},
    {.info = {.kind = "value", .doc = "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL., or a constant (32 bits, or a real with a decimal point).",
              .good = "CELL1", .bad = "BIT0", .badCode = "wrong-operand-kind"},
     .prefixes = kCells | kCnst, .constant = true},
    {.info = {.kind = "narrow value", .doc = "As a value, but of at most 32 bits: QWRD. is not allowed (man. l.1076).", .good = "CELL1", .bad = "QWRD.ARRAY", .badCode = "invalid-type-prefix"},
     .prefixes = kByte | kWord | kHigh | kDword | kReal | kCnst, .constant = true},
    {.info = {.kind = "bitwise value", .doc = "A cell or constant of at most 32 bits; REAL. and QWRD. are not allowed (man. l.1183).", .good = "CELL1", .bad = "REAL.ARRAY", .badCode = "invalid-type-prefix"},
     .prefixes = kByte | kWord | kHigh | kDword | kCnst, .constant = true},
    {.info = {.kind = "cell", .doc = "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL.", .good = "CELL1", .bad = "5", .badCode = "wrong-operand-kind"},
     .prefixes = kCells},
    {.info = {.kind = "timer cell", .doc = "A BYTE or WORD cell, or `-` for an automatic one.", .good = "CELL2", .bad = "CELL4", .badCode = "wrong-operand-kind"},
     .prefixes = kByte | kWord, .notGiven = true, .types = kShort},
    {.info = {.kind = "counter cell", .doc = "A BYTE or WORD cell, without a prefix.", .good = "CELL2", .bad = "CELL4", .badCode = "wrong-operand-kind"}, .types = kShort},
    {.info = {.kind = "time", .doc = "A constant or a BYTE or WORD cell, in cycles of the PLC (20 ms).", .good = "50", .bad = "BIT0", .badCode = "wrong-operand-kind"},
     .prefixes = kByte | kWord | kCnst, .constant = true, .types = kShort},
    {.info = {.kind = "shift count", .doc = "A constant, or a cell of 8 bits.", .good = "3", .bad = "WORD.CELL2", .badCode = "invalid-type-prefix"},
     .prefixes = kByte | kHigh | kCnst, .constant = true, .types = ir::setOf(ir::Type::I8)},
    {.info = {.kind = "constant", .doc = "A constant.", .good = "4", .bad = "CELL1", .badCode = "wrong-operand-kind"}, .prefixes = kCnst, .cell = false, .constant = true},
    {.info = {.kind = "message value", .doc = "A constant or a cell, or `-`.", .good = "12", .bad = "BIT0", .badCode = "wrong-operand-kind"},
     .prefixes = kByte | kWord | kDword | kCnst, .constant = true, .notGiven = true},
    {.info = {.kind = "address", .doc = "A variable, also with an offset; its type does not matter.", .good = "ARRAY", .bad = "5", .badCode = "wrong-operand-kind"},
     .parse = C::Text},
    {.info = {.kind = "text", .doc = "A text variable, also with an offset.", .good = "TEXT1", .bad = "5", .badCode = "wrong-operand-kind"}, .parse = C::Text},
    {.info = {.kind = "text or literal", .doc = "A text variable, also with an offset, or a text in apostrophes.", .good = "'AB'", .bad = "5", .badCode = "wrong-operand-kind"},
     .parse = C::Text, .text = true},
    {.info = {.kind = "width", .doc = "DWRD, QWRD or REAL; without it 16 bits.", .good = "DWRD", .bad = "BYTE", .badCode = "syntax-error"},
     .parse = C::Keyword, .prefixes = kDword | kQword | kReal},
    {.info = {.kind = "integer width", .doc = "DWRD or QWRD; without it 16 bits.", .good = "QWRD", .bad = "REAL", .badCode = "syntax-error"},
     .parse = C::Keyword, .prefixes = kDword | kQword},
    {.info = {.kind = "double width", .doc = "DWRD; without it 16 bits.", .good = "DWRD", .bad = "QWRD", .badCode = "syntax-error"}, .parse = C::Keyword, .prefixes = kDword},
    {.info = {.kind = "bits of DR", .doc = "DWRD for 32 bits, or the number 0..31 of one bit; without it 16 bits.", .good = "7", .bad = "32", .badCode = "operand-range"},
     .parse = C::Keyword, .prefixes = kDword, .constant = true},
    {.info = {.kind = "label", .doc = "A label of the same module, mechanism, procedure or timed block.", .good = "LABEL1", .bad = "CELL1", .badCode = "wrong-operand-kind"},
     .parse = C::Name, .name = SymbolKind::Label},
    {.info = {.kind = "mechanism", .doc = "The name of a mechanism.", .good = "MECH1", .bad = "CELL1", .badCode = "wrong-operand-kind"}, .parse = C::Name, .name = SymbolKind::Mechanism},
    {.info = {.kind = "procedure", .doc = "The name of a procedure.", .good = "PROC1", .bad = "CELL1", .badCode = "wrong-operand-kind"}, .parse = C::Name, .name = SymbolKind::Procedure},
    {.info = {.kind = "register", .doc = "BX or CX.", .good = "BX", .bad = "AX", .badCode = "unsupported-assembler"}, .parse = C::Keyword},
    {.info = {.kind = "declaration", .doc = "Part of a declaration: a name, a number, a text; see the instruction."}, .parse = C::Keyword},
};

constexpr auto kInfos = [] {
  std::array<OperandKindInfo, std::size(kKinds)> infos{};
  for (size_t i = 0; i < infos.size(); ++i) infos[i] = kKinds[i].info;
  return infos;
}();

} // namespace

std::span<const OperandKind> operandKinds() { return kKinds; }
std::span<const OperandKindInfo> operandKindInfos() { return kInfos; }

const OperandKind* findOperandKind(std::string_view kind) {
  for (const OperandKind& k : kKinds)
    if (k.info.kind == kind) return &k;
  return nullptr;
}

} // namespace rung::frontend::technol
