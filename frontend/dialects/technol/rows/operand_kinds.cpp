// The classes of operands: what may be written for each, an operand that is right, one that is wrong and its code, for
// the parser, the reference and generated tests.
#include "frontend/dialects/technol/rows/operand_kinds.h"

#include <array>

#include "rtlib/nc/technol/exchange.h"
#include "rtlib/nc/technol/licences.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {
namespace {

using C = OperandClass;

// The codes of wrong operands.
constexpr std::string_view kWrongKind = "wrong-operand-kind", kRange = "operand-range", kPrefix = "invalid-type-prefix";

constexpr uint8_t kCells = kByte | kWord | kHigh | kDword | kReal | kQword;
constexpr uint8_t kNumber = kByte | kWord | kHigh | kDword | kCnst;
constexpr ir::TypeSet kIntegers = ir::setOf(ir::Type::I8) | ir::setOf(ir::Type::I16) | ir::setOf(ir::Type::I32);
constexpr ir::TypeSet kShort = ir::setOf(ir::Type::I8) | ir::setOf(ir::Type::I16);

constexpr OperandKind kKinds[] = {
    {.info = {"bit",
              "A bit, also negated or at an address: `ALFA`, `-ALFA`, `BUN5.ALFA`, `(BUN5+3).ALFA`, `$+1.ALFA`, "
              "`BUN5[BX].ALFA`, `BLK[0].M3`.",
              "BIT0", "CELL1", kWrongKind},
     .parse = C::Bit,
     .sign = true},
    {.info = {"plain bit", "A bit without a sign, also at an address.", "BIT0", "-BIT0", kWrongKind}, .parse = C::Bit},
    {.info = {"flag", "0 or 1.", "1", "2", kRange}, .cell = false, .constant = true},
    {.info = {"signed value",
              "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL., or a constant (32 bits, or a "
              "real with a decimal point); `-` takes it negative.",
              "CELL1", "BIT0", kWrongKind},
     .prefixes = kCells | kCnst,
     .sign = true,
     .constant = true},
    {.info = {"value",
              "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL., or a constant (32 bits, or a "
              "real with a decimal point).",
              "CELL1", "BIT0", kWrongKind},
     .prefixes = kCells | kCnst,
     .constant = true},
    {.info = {"narrow value", "As a value, but of at most 32 bits: QWRD. is not allowed (man. l.1076).", "CELL1",
              "QWRD.ARRAY", kPrefix},
     .prefixes = kByte | kWord | kHigh | kDword | kReal | kCnst,
     .constant = true},
    {.info = {"bitwise value", "A cell or constant of at most 32 bits; REAL. and QWRD. are not allowed (man. l.1183).",
              "CELL1", "REAL.ARRAY", kPrefix},
     .prefixes = kByte | kWord | kHigh | kDword | kCnst,
     .constant = true},
    {.info = {"cell", "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL.", "CELL1", "5",
              kWrongKind},
     .prefixes = kCells},
    {.info = {"integer cell", "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD.", "CELL4",
              "REAL.ARRAY", kPrefix},
     .prefixes = kByte | kWord | kHigh | kDword | kQword},
    {.info = {"real cell", "A cell of 8 bytes, also with the prefix REAL.", "ARRAY", "CELL4", kPrefix},
     .prefixes = kReal},
    {.info =
         {"real value",
          "A cell of 8 bytes, also with the prefix REAL., or a constant, also written CNST.0.2; `-` takes it negative.",
          "0.2", "CELL4", kPrefix},
     .prefixes = kReal | kCnst,
     .sign = true,
     .constant = true},
    {.info = {"bit or flag", "A bit without a sign, 0 or 1.", "1", "2", kRange}, .parse = C::Bit, .constant = true},
    {.info = {"timer cell", "A BYTE or WORD cell, or `-` for an automatic one.", "CELL2", "CELL4", kWrongKind},
     .prefixes = kByte | kWord,
     .notGiven = true,
     .types = kShort},
    {.info = {"counter cell", "A BYTE or WORD cell, without a prefix.", "CELL2", "CELL4", kWrongKind}, .types = kShort},
    {.info = {"time", "A constant or a BYTE or WORD cell, in cycles of the PLC (20 ms).", "50", "BIT0", kWrongKind},
     .prefixes = kByte | kWord | kCnst,
     .constant = true,
     .types = kShort},
    {.info = {"shift count", "A constant, or a cell of 8 bits.", "3", "WORD.CELL2", kPrefix},
     .prefixes = kByte | kHigh | kCnst,
     .constant = true,
     .types = ir::setOf(ir::Type::I8)},
    {.info = {"constant", "A constant.", "4", "CELL1", kWrongKind}, .prefixes = kCnst, .cell = false, .constant = true},
    {.info = {"message value", "A constant or a cell, or `-`.", "12", "BIT0", kWrongKind},
     .prefixes = kByte | kWord | kDword | kCnst,
     .constant = true,
     .notGiven = true},
    {.info = {"message number", "A constant or a cell.", "12", "BIT0", kWrongKind},
     .prefixes = kByte | kWord | kDword | kCnst,
     .constant = true},
    {.info = {"status byte", "The variable that holds the bit, also with an offset (`+n`, `+BX`), or `-`.", "CELL1",
              "5", kWrongKind},
     .parse = C::Text,
     .notGiven = true,
     .empty = true},
    {.info = {"status bit", "The name of a bit.", "BIT0", "CELL1", kWrongKind}, .parse = C::Bit, .weight = true},
    {.info = {"message switch", "0, 1 or a cell, or `-`.", "1", "2", kRange},
     .prefixes = kByte | kWord | kDword | kCnst,
     .constant = true,
     .notGiven = true},
    {.info = {"address", "A variable, also with an offset; its type does not matter.", "ARRAY", "5", kWrongKind},
     .parse = C::Text},
    {.info = {"beginning", "A variable, also with an offset, or GLOBAL or INTERNAL before ALL.", "ARRAY", "5",
              kWrongKind},
     .parse = C::Text,
     .keywords = "GLOBAL INTERNAL"},
    {.info = {"end", "A variable, also with an offset, or ALL after GLOBAL or INTERNAL.", "ARRAY", "5", kWrongKind},
     .parse = C::Text,
     .keywords = "ALL"},
    {.info = {"length", "A constant, or a BYTE or WORD cell: how many bytes.", "2", "BIT0", kWrongKind},
     .prefixes = kByte | kWord | kCnst,
     .constant = true,
     .types = kShort},
    {.info = {"text", "A text variable, also with an offset.", "TEXT1", "5", kWrongKind}, .parse = C::Text},
    {.info = {"text or literal", "A text variable, also with an offset, or a text in apostrophes.", "'AB'", "5",
              kWrongKind},
     .parse = C::Text,
     .text = true},
    {.info = {"width", "DWRD, QWRD or REAL; without it 16 bits.", "DWRD", "BYTE", kPrefix},
     .parse = C::Keyword,
     .prefixes = kDword | kQword | kReal},
    {.info = {"integer width", "DWRD or QWRD; without it 16 bits.", "QWRD", "REAL", kPrefix},
     .parse = C::Keyword,
     .prefixes = kDword | kQword},
    {.info = {"double width", "DWRD; without it 16 bits.", "DWRD", "QWRD", kPrefix},
     .parse = C::Keyword,
     .prefixes = kDword},
    {.info = {"bits of DR", "DWRD for 32 bits, or the number 0..31 of one bit; without it 16 bits.", "7", "32", kRange},
     .parse = C::Keyword,
     .prefixes = kDword,
     .constant = true},
    {.info = {"label", "A label of the same module, mechanism, procedure or timed block.", "LABEL1", "CELL1",
              kWrongKind},
     .parse = C::Name,
     .name = SymbolKind::Label},
    {.info = {"mechanism", "The name of a mechanism.", "MECH1", "CELL1", kWrongKind},
     .parse = C::Name,
     .name = SymbolKind::Mechanism},
    {.info = {"procedure", "The name of a procedure.", "PROC1", "CELL1", kWrongKind},
     .parse = C::Name,
     .name = SymbolKind::Procedure},
    {.info = {"register", "BX or CX.", "BX", "AX", "unsupported-assembler"}, .parse = C::Keyword},
    {.info = {"licence", "HwKeyConnected, or FeaturePlc0 to FeaturePlc9.", "FeaturePlc1", "CELL1", kWrongKind},
     .parse = C::Keyword,
     .keywords = nc::kLicences},
    // ---- services -------------------------------------------------------------------------------------------------
    {.info = {"number", "A constant, or a cell of at most 32 bits.", "1", "BIT0", kWrongKind},
     .prefixes = kNumber,
     .constant = true,
     .types = kIntegers},
    {.info = {"number or -", "A constant, a cell of at most 32 bits, or `-` where it is not given.", "CELL2", "BIT0",
              kWrongKind},
     .prefixes = kNumber,
     .constant = true,
     .notGiven = true,
     .types = kIntegers},
    {.info = {"number or nothing", "A constant, a cell of at most 32 bits, or `-` or nothing where it is not given.",
              "CELL2", "BIT0", kWrongKind},
     .prefixes = kNumber,
     .constant = true,
     .notGiven = true,
     .empty = true,
     .types = kIntegers},
    {.info = {"axis",
              "A constant, a cell of at most 32 bits, or the name of an axis, one of X Y Z A B C U V W (man. l.8018, "
              "l.8302).",
              "4", "17", kRange},
     .prefixes = kNumber,
     .constant = true,
     .types = kIntegers,
     .keywords = "X Y Z A B C U V W"},
    {.info = {"spindle", "0 none, 1 main, 2 assistant, or S: as SPI_MAIN has set it (man. l.7984).", "S", "3", kRange},
     .prefixes = kNumber,
     .constant = true,
     .types = kIntegers,
     .keywords = "S"},
    {.info = {"byte cell", "A cell of 8 bits, also with the prefix BYTE.", "CELL1", "CELL4", kWrongKind},
     .prefixes = kByte | kHigh,
     .types = ir::setOf(ir::Type::I8)},
    {.info = {"word cell", "A cell of 16 bits, also with the prefix WORD.", "CELL2", "CELL4", kWrongKind},
     .prefixes = kWord,
     .types = ir::setOf(ir::Type::I16)},
    {.info = {"dword cell", "A cell of 32 bits, also with the prefix DWRD.", "CELL4", "CELL2", kWrongKind},
     .prefixes = kDword,
     .types = ir::setOf(ir::Type::I32)},
    {.info = {"cell or text", "A variable or a text, also with an offset or a prefix.", "CELL4", "5", kWrongKind},
     .parse = C::Text,
     .prefixes = kCells},
    {.info = {"bit or nothing", "A bit without a sign, or `-`, NIL or nothing where it is not given.", "BIT0", "CELL1",
              kWrongKind},
     .parse = C::Bit,
     .notGiven = true,
     .empty = true},
    {.info = {"item of a unit", "A member of the structure INOUTS.", "ANL0", "4", kWrongKind},
     .parse = C::Keyword,
     .structure = "INOUTS"},
    {.info = {"line command", "CLEAR, RECEIVED or STATE.", "STATE", "4", kWrongKind},
     .parse = C::Keyword,
     .keywords = "CLEAR RECEIVED STATE"},
    {.info = {kNewBit, "The name of the bit that is declared.", "NEW1", "5", kWrongKind}, .parse = C::Variable},
    {.info = {kNewReal, "The name of the cell that is declared, a real.", "NEW1", "5", kWrongKind},
     .parse = C::Variable},
    {.info = {kNewVariable,
              "The name of the variable that is declared; with `[n]` an array of n elements or a text of n characters.",
              "NEW1", "5", kWrongKind},
     .parse = C::Variable,
     .constant = true},
    {.info = {kLogicalInput, "The name of a variable of DEF_IN, with `[i]` one element.", "INPUT1", "CELL1",
              kWrongKind},
     .parse = C::Variable,
     .constant = true},
    {.info = {kBitName, "The name of a bit, used as its number in a byte.", "BIT0", "CELL1", kWrongKind},
     .parse = C::Variable},
    {.info = {"type",
              "TYPE_BIT, TYPE_INT_8, TYPE_UNS_8 or TYPE_BYTE, TYPE_INT_16, TYPE_UNS_16 or TYPE_WORD, TYPE_INT_32, "
              "TYPE_UNS_32 or TYPE_DWORD, TYPE_INT_64, TYPE_UNS_64 or TYPE_QWORD, TYPE_REAL, TYPE_STR, TYPE_BIN.",
              "TYPE_DWORD", "5", kWrongKind},
     .parse = C::Keyword,
     .keywords = nc::kExchangeTypeWords},
    {.info = {"FAST", "FAST: served every millisecond.", "FAST", "5", kWrongKind},
     .parse = C::Keyword,
     .notGiven = true,
     .keywords = "FAST"},
    {.info = {"period", "SLOW, FAST, FASTEST or ONDEMAND; without it SLOW.", "ONDEMAND", "5", kWrongKind},
     .parse = C::Keyword,
     .notGiven = true,
     .keywords = nc::kExchangePeriodWords},
    {.info = {"default bit", "0 or 1, or `-`.", "1", "2", kRange},
     .prefixes = kCnst,
     .cell = false,
     .constant = true,
     .notGiven = true},
    {.info = {"default real", "A real constant with its decimal point, or `-`.", "0.5", "CELL1", kWrongKind},
     .prefixes = kReal | kCnst,
     .sign = true,
     .cell = false,
     .constant = true,
     .notGiven = true},
    {.info = {"default value", "A constant of the variable's type, or `-`.", "7", "CELL1", kWrongKind},
     .prefixes = kReal | kCnst,
     .sign = true,
     .cell = false,
     .constant = true,
     .notGiven = true,
     .text = true},
    {.info = {"limit or length",
              "A cell of 8 bytes that holds the least value; of TYPE_STR and TYPE_BIN a constant: how many bytes.",
              "ARRAY", "BIT0", kWrongKind},
     .prefixes = kReal | kCnst,
     .constant = true,
     .notGiven = true},
    {.info = {"declaration", "Part of a declaration: a name, a number, a text; see the instruction."},
     .parse = C::Keyword},
};

constexpr auto kInfos = [] {
  std::array<OperandKindInfo, std::size(kKinds)> infos{};
  for (size_t i = 0; i < infos.size(); ++i) infos[i] = kKinds[i].info;
  return infos;
}();

} // namespace

std::span<const OperandKind> operandKinds() { return kKinds; }
std::span<const OperandKindInfo> operandKindInfos() { return kInfos; }

int64_t numberOfWord(std::string_view words, std::string_view wanted) {
  int64_t found = -1;
  forEachWord(words, [&](std::string_view word, int64_t number) {
    if (text::equalsIgnoringCase(wanted, word)) found = number;
  });
  return found;
}

const OperandKind* findOperandKind(std::string_view kind) {
  for (const OperandKind& k : kKinds)
    if (k.info.kind == kind) return &k;
  return nullptr;
}

} // namespace rung::frontend::technol
