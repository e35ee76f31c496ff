// Kinds of operands: what a row may ask for.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "frontend/dialects/technol/records.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/nc/technol/licences.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {

// Which type prefixes a kind takes.
enum Prefix : uint8_t { kByte = 1, kWord = 2, kDword = 4, kQword = 8, kHigh = 16, kReal = 32, kCnst = 64 };

enum class OperandClass : uint8_t { Bit, Value, Name, Keyword, Text, Variable };

struct OperandTraits {
  OperandClass parse = OperandClass::Value;
  uint8_t prefixes = 0;
  bool sign = false;                     // `-` before it
  bool cell = true;                      // a cell may be written
  bool constant = false;                 // a constant may
  bool notGiven = false;                 // `-` or NIL may
  bool empty = false;                    // nothing may, between commas
  bool text = false;                     // a text may
  bool weight = false;                   // class Bit: a number of a bit may, without an address; Variable: it does
  uint8_t types = 0xFF;                  // ir::TypeSet of cells
  SymbolKind symbol = SymbolKind::Label; // class Name
  std::string_view keywords = {};        // parted by blanks; beside what else may be written
  int64_t firstWord = 0;                 // the number that the first of them has for a device
  bool axis = false;                     // they are names of axes, which the configuration may replace
  const char* structure = nullptr;       // of the control: class Keyword, one of its members
  bool ownName = false;                  // class Keyword: written as the row calls the operand
  bool onlyTexts = false;                // class Text: no other variables
  bool pastEnd = false;                  // class Text: may be the place after the last byte of its memory
  bool input = false;                    // class Variable: of DEF_IN; else one that the statement declares
  bool timed = false;                    // the operand after it is the time that it counts
  bool twosComplement = false;           // a cell has a sign
};

struct OperandKind : OperandKindInfo, OperandTraits {};

inline const OperandKind& kindOf(const OperandInfo& operand) { return static_cast<const OperandKind&>(*operand.kind); }

// Calls visit(word, number) for the words of a list, which are parted by blanks.
template <class Visit>
void forEachWord(std::string_view words, Visit visit) {
  for (int64_t number = 0; !words.empty(); ++number) {
    const size_t end = std::min(words.find(' '), words.size());
    visit(words.substr(0, end), number);
    words.remove_prefix(std::min(end + 1, words.size()));
  }
}
// The number of a word in a list, in any case; -1: it is not there.
inline int64_t numberOfWord(std::string_view words, std::string_view wanted) {
  int64_t found = -1;
  forEachWord(words, [&](std::string_view word, int64_t number) {
    if (text::equalsIgnoringCase(wanted, word)) found = number;
  });
  return found;
}

// A new kind is one descriptor here, and the rows that name it.
namespace kinds {

using C = OperandClass;

// The codes of wrong operands.
inline constexpr std::string_view kWrongKind = "wrong-operand-kind", kRange = "operand-range",
                                  kPrefix = "invalid-type-prefix";

inline constexpr uint8_t kCells = kByte | kWord | kHigh | kDword | kReal | kQword;
inline constexpr uint8_t kNumberPrefixes = kByte | kWord | kHigh | kDword | kCnst;
inline constexpr ir::TypeSet kIntegers = ir::setOf(ir::Type::I8) | ir::setOf(ir::Type::I16) | ir::setOf(ir::Type::I32);
inline constexpr ir::TypeSet kShort = ir::setOf(ir::Type::I8) | ir::setOf(ir::Type::I16);

inline constexpr OperandKind kBit{{"bit",
                                   "A bit, also negated or at an address: `ALFA`, `-ALFA`, `BUN5.ALFA`, "
                                   "`(BUN5+3).ALFA`, `$+1.ALFA`, `BUN5[BX].ALFA`, `BLK[0].M3`.",
                                   "BIT0", "CELL1", kWrongKind},
                                  {.parse = C::Bit, .sign = true}};
inline constexpr OperandKind kPlainBit{
    {"plain bit", "A bit without a sign, also at an address.", "BIT0", "-BIT0", kWrongKind}, {.parse = C::Bit}};
inline constexpr OperandKind kFlag{{"flag", "0 or 1.", "1", "2", kRange}, {.cell = false, .constant = true}};
inline constexpr OperandKind kSignedValue{
    {"signed value",
     "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL., or a constant (32 bits, or a real with "
     "a decimal point); `-` takes it negative.",
     "CELL1", "BIT0", kWrongKind},
    {.prefixes = kCells | kCnst, .sign = true, .constant = true}};
inline constexpr OperandKind kValue{{"value",
                                     "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL., or a "
                                     "constant (32 bits, or a real with a decimal point).",
                                     "CELL1", "BIT0", kWrongKind},
                                    {.prefixes = kCells | kCnst, .constant = true}};
inline constexpr OperandKind kNarrowValue{
    {"narrow value", "As a value, but of at most 32 bits: QWRD. is not allowed (man. l.1076).", "CELL1", "QWRD.ARRAY",
     kPrefix},
    {.prefixes = kByte | kWord | kHigh | kDword | kReal | kCnst, .constant = true}};
inline constexpr OperandKind kBitwiseValue{
    {"bitwise value", "A cell or constant of at most 32 bits; REAL. and QWRD. are not allowed (man. l.1183).", "CELL1",
     "REAL.ARRAY", kPrefix},
    {.prefixes = kByte | kWord | kHigh | kDword | kCnst, .constant = true}};
inline constexpr OperandKind kCell{
    {"cell", "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL.", "CELL1", "5", kWrongKind},
    {.prefixes = kCells}};
inline constexpr OperandKind kIntegerCell{{"integer cell",
                                           "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD.",
                                           "CELL4", "REAL.ARRAY", kPrefix},
                                          {.prefixes = kByte | kWord | kHigh | kDword | kQword}};
inline constexpr OperandKind kRealCell{
    {"real cell", "A cell of 8 bytes, also with the prefix REAL.", "ARRAY", "CELL4", kPrefix}, {.prefixes = kReal}};
inline constexpr OperandKind kRealValue{
    {"real value",
     "A cell of 8 bytes, also with the prefix REAL., or a constant, also written CNST.0.2; `-` takes it negative.",
     "0.2", "CELL4", kPrefix},
    {.prefixes = kReal | kCnst, .sign = true, .constant = true}};
inline constexpr OperandKind kBitOrFlag{{"bit or flag", "A bit without a sign, 0 or 1.", "1", "2", kRange},
                                        {.parse = C::Bit, .constant = true}};
inline constexpr OperandKind kTimerCell{
    {"timer cell", "A BYTE or WORD cell, or `-` for an automatic one.", "CELL2", "CELL4", kWrongKind},
    {.prefixes = kByte | kWord, .notGiven = true, .types = kShort, .timed = true}};
inline constexpr OperandKind kCounterCell{
    {"counter cell", "A BYTE or WORD cell, without a prefix.", "CELL2", "CELL4", kWrongKind}, {.types = kShort}};
inline constexpr OperandKind kTime{
    {"time", "A constant or a BYTE or WORD cell, in cycles of the PLC (20 ms).", "50", "BIT0", kWrongKind},
    {.prefixes = kByte | kWord | kCnst, .constant = true, .types = kShort}};
inline constexpr OperandKind kShiftCount{
    {"shift count", "A constant, or a cell of 8 bits.", "3", "WORD.CELL2", kPrefix},
    {.prefixes = kByte | kHigh | kCnst, .constant = true, .types = ir::setOf(ir::Type::I8)}};
inline constexpr OperandKind kConstant{{"constant", "A constant.", "4", "CELL1", kWrongKind},
                                       {.prefixes = kCnst, .cell = false, .constant = true}};
inline constexpr OperandKind kMessageValue{
    {"message value", "A constant or a cell, or `-`.", "12", "BIT0", kWrongKind},
    {.prefixes = kByte | kWord | kDword | kCnst, .constant = true, .notGiven = true}};
inline constexpr OperandKind kMessageNumber{{"message number", "A constant or a cell.", "12", "BIT0", kWrongKind},
                                            {.prefixes = kByte | kWord | kDword | kCnst, .constant = true}};
inline constexpr OperandKind kStatusByte{{"status byte",
                                          "The variable that holds the bit, also with an offset (`+n`, `+BX`), or `-`.",
                                          "CELL1", "5", kWrongKind},
                                         {.parse = C::Text, .notGiven = true, .empty = true}};
inline constexpr OperandKind kStatusBit{{"status bit", "The name of a bit.", "BIT0", "CELL1", kWrongKind},
                                        {.parse = C::Bit, .weight = true}};
inline constexpr OperandKind kMessageSwitch{
    {"message switch", "0, 1 or a cell, or `-`.", "1", "2", kRange},
    {.prefixes = kByte | kWord | kDword | kCnst, .constant = true, .notGiven = true}};
inline constexpr OperandKind kAddress{
    {"address", "A variable, also with an offset; its type does not matter.", "ARRAY", "5", kWrongKind},
    {.parse = C::Text}};
inline constexpr OperandKind kBeginning{
    {"beginning", "A variable, also with an offset, or GLOBAL or INTERNAL before ALL.", "ARRAY", "5", kWrongKind},
    {.parse = C::Text, .keywords = "GLOBAL INTERNAL"}};
inline constexpr OperandKind kEnd{
    {"end", "A variable, also with an offset, or ALL after GLOBAL or INTERNAL.", "ARRAY", "5", kWrongKind},
    {.parse = C::Text, .keywords = "ALL", .pastEnd = true}};
inline constexpr OperandKind kLength{
    {"length", "A constant, or a BYTE or WORD cell: how many bytes.", "2", "BIT0", kWrongKind},
    {.prefixes = kByte | kWord | kCnst, .constant = true, .types = kShort}};
inline constexpr OperandKind kText{{"text", "A text variable, also with an offset.", "TEXT1", "5", kWrongKind},
                                   {.parse = C::Text, .onlyTexts = true}};
inline constexpr OperandKind kTextOrLiteral{
    {"text or literal", "A text variable, also with an offset, or a text in apostrophes.", "'AB'", "5", kWrongKind},
    {.parse = C::Text, .text = true, .onlyTexts = true}};
inline constexpr OperandKind kWidth{{"width", "DWRD, QWRD or REAL; without it 16 bits.", "DWRD", "BYTE", kPrefix},
                                    {.parse = C::Keyword, .prefixes = kDword | kQword | kReal}};
inline constexpr OperandKind kIntegerWidth{
    {"integer width", "DWRD or QWRD; without it 16 bits.", "QWRD", "REAL", kPrefix},
    {.parse = C::Keyword, .prefixes = kDword | kQword}};
inline constexpr OperandKind kDoubleWidth{{"double width", "DWRD; without it 16 bits.", "DWRD", "QWRD", kPrefix},
                                          {.parse = C::Keyword, .prefixes = kDword}};
inline constexpr OperandKind kBitsOfDr{
    {"bits of DR", "DWRD for 32 bits, or the number 0..31 of one bit; without it 16 bits.", "7", "32", kRange},
    {.parse = C::Keyword, .prefixes = kDword, .constant = true}};
inline constexpr OperandKind kLabel{
    {"label", "A label of the same module, mechanism, procedure or timed block.", "LABEL1", "CELL1", kWrongKind},
    {.parse = C::Name, .symbol = SymbolKind::Label}};
inline constexpr OperandKind kMechanism{{"mechanism", "The name of a mechanism.", "MECH1", "CELL1", kWrongKind},
                                        {.parse = C::Name, .symbol = SymbolKind::Mechanism}};
inline constexpr OperandKind kProcedure{{"procedure", "The name of a procedure.", "PROC1", "CELL1", kWrongKind},
                                        {.parse = C::Name, .symbol = SymbolKind::Procedure}};
inline constexpr OperandKind kRegister{{"register", "BX or CX.", "BX", "AX", "unsupported-assembler"},
                                       {.parse = C::Keyword, .ownName = true}};
inline constexpr OperandKind kLicence{
    {"licence", "HwKeyConnected, or FeaturePlc0 to FeaturePlc9.", "FeaturePlc1", "CELL1", kWrongKind},
    {.parse = C::Keyword, .keywords = nc::kLicences}};
// ---- services -------------------------------------------------------------------------------------------------
inline constexpr OperandKind kNumber{{"number", "A constant, or a cell of at most 32 bits.", "1", "BIT0", kWrongKind},
                                     {.prefixes = kNumberPrefixes, .constant = true, .types = kIntegers}};
inline constexpr OperandKind kNumberOrDash{
    {"number or -", "A constant, a cell of at most 32 bits, or `-` where it is not given.", "CELL2", "BIT0",
     kWrongKind},
    {.prefixes = kNumberPrefixes, .constant = true, .notGiven = true, .types = kIntegers}};
inline constexpr OperandKind kSignedOrDash{
    {"signed number or -", "A constant or a cell of at most 32 bits in two's complement, or `-` where it is not given.",
     "CELL2", "BIT0", kWrongKind},
    {.prefixes = kNumberPrefixes, .constant = true, .notGiven = true, .types = kIntegers, .twosComplement = true}};
inline constexpr OperandKind kSignedOrNothing{
    {"signed number or nothing",
     "A constant or a cell of at most 32 bits in two's complement, or `-` or nothing where it is not given.", "CELL2",
     "BIT0", kWrongKind},
    {.prefixes = kNumberPrefixes,
     .constant = true,
     .notGiven = true,
     .empty = true,
     .types = kIntegers,
     .twosComplement = true}};
inline constexpr OperandKind kDistance{
    {"distance", "A cell of 32 bits in two's complement, also with the prefix DWRD.", "CELL4", "CELL2", kWrongKind},
    {.prefixes = kDword, .types = ir::setOf(ir::Type::I32), .twosComplement = true}};
inline constexpr OperandKind kNumberOrNothing{
    {"number or nothing", "A constant, a cell of at most 32 bits, or `-` or nothing where it is not given.", "CELL2",
     "BIT0", kWrongKind},
    {.prefixes = kNumberPrefixes, .constant = true, .notGiven = true, .empty = true, .types = kIntegers}};
inline constexpr OperandKind kAxis{{"axis",
                                    "A constant, a cell of at most 32 bits, or the name of an axis, one of X Y Z C A B "
                                    "U V W, which are 1 to 9, or of the letters of `config axes`, which are 1 and on "
                                    "(man. l.8018, l.8052, l.8302).",
                                    "4", "17", kRange},
                                   {.prefixes = kNumberPrefixes,
                                    .constant = true,
                                    .types = kIntegers,
                                    .keywords = "X Y Z C A B U V W",
                                    .firstWord = 1,
                                    .axis = true}};
inline constexpr OperandKind kSpindle{
    {"spindle", "0 none, 1 main, 2 assistant, or S: as SPI_MAIN has set it (man. l.7984).", "S", "3", kRange},
    {.prefixes = kNumberPrefixes,
     .constant = true,
     .types = kIntegers,
     .keywords = nc::technol::kSpindleWords,
     .firstWord = nc::technol::kFirstSpindleWord}};
inline constexpr OperandKind kByteCell{
    {"byte cell", "A cell of 8 bits, also with the prefix BYTE.", "CELL1", "CELL4", kWrongKind},
    {.prefixes = kByte | kHigh, .types = ir::setOf(ir::Type::I8)}};
inline constexpr OperandKind kWordCell{
    {"word cell", "A cell of 16 bits, also with the prefix WORD.", "CELL2", "CELL4", kWrongKind},
    {.prefixes = kWord, .types = ir::setOf(ir::Type::I16)}};
inline constexpr OperandKind kDwordCell{
    {"dword cell", "A cell of 32 bits, also with the prefix DWRD.", "CELL4", "CELL2", kWrongKind},
    {.prefixes = kDword, .types = ir::setOf(ir::Type::I32)}};
inline constexpr OperandKind kCellOrText{
    {"cell or text", "A variable or a text, also with an offset or a prefix.", "CELL4", "5", kWrongKind},
    {.parse = C::Text, .prefixes = kCells}};
inline constexpr OperandKind kRealOrText{{"real or text",
                                          "A variable of 8 bytes or a text, also with an offset or the prefix REAL.",
                                          "RATIO", "5", kWrongKind},
                                         {.parse = C::Text, .prefixes = kReal}};
inline constexpr OperandKind kBitOrNothing{{"bit or nothing",
                                            "A bit without a sign, or `-`, NIL or nothing where it is not given.",
                                            "BIT0", "CELL1", kWrongKind},
                                           {.parse = C::Bit, .notGiven = true, .empty = true}};
inline constexpr OperandKind kItemOfAUnit{
    {"item of a unit", "A member of the structure INOUTS.", "ANL0", "4", kWrongKind},
    {.parse = C::Keyword, .structure = "INOUTS"}};
inline constexpr OperandKind kLineCommand{
    {"line command", "CLEAR, RECEIVED or STATE.", "STATE", "4", kWrongKind},
    {.parse = C::Keyword, .keywords = nc::technol::kLineCommandWords, .firstWord = nc::technol::kFirstLineCommand}};
inline constexpr OperandKind kNewBit{{"new bit", "The name of the bit that is declared.", "NEW1", "5", kWrongKind},
                                     {.parse = C::Variable}};
inline constexpr OperandKind kNewReal{
    {"new real", "The name of the cell that is declared, a real.", "NEW1", "5", kWrongKind}, {.parse = C::Variable}};
inline constexpr OperandKind kNewVariable{
    {"new variable",
     "The name of the variable that is declared; with `[n]` an array of n elements or a text of n characters.", "NEW1",
     "5", kWrongKind},
    {.parse = C::Variable, .constant = true}};
inline constexpr OperandKind kLogicalInput{
    {"logical input", "The name of a variable of DEF_IN, with `[i]` one element.", "INPUT1", "CELL1", kWrongKind},
    {.parse = C::Variable, .constant = true, .input = true}};
inline constexpr OperandKind kBitName{
    {"name of a bit", "The name of a bit, used as its number in a byte.", "BIT0", "CELL1", kWrongKind},
    {.parse = C::Variable, .weight = true}};
inline constexpr OperandKind kType{
    {"type",
     "TYPE_BIT, TYPE_INT_8, TYPE_UNS_8 or TYPE_BYTE, TYPE_INT_16, TYPE_UNS_16 or TYPE_WORD, TYPE_INT_32, TYPE_UNS_32 "
     "or TYPE_DWORD, TYPE_INT_64, TYPE_UNS_64 or TYPE_QWORD, TYPE_REAL, TYPE_STR, TYPE_BIN.",
     "TYPE_DWORD", "5", kWrongKind},
    {.parse = C::Keyword, .keywords = nc::kExchangeTypeWords}};
inline constexpr OperandKind kFast{{"FAST", "FAST: served every millisecond.", "FAST", "5", kWrongKind},
                                   {.parse = C::Keyword, .notGiven = true, .keywords = "FAST"}};
inline constexpr OperandKind kPeriod{
    {"period", "SLOW, FAST, FASTEST or ONDEMAND; without it SLOW.", "ONDEMAND", "5", kWrongKind},
    {.parse = C::Keyword, .notGiven = true, .keywords = nc::kExchangePeriodWords}};
inline constexpr OperandKind kDefaultBit{{"default bit", "0 or 1, or `-`.", "1", "2", kRange},
                                         {.prefixes = kCnst, .cell = false, .constant = true, .notGiven = true}};
inline constexpr OperandKind kDefaultReal{
    {"default real", "A real constant with its decimal point, or `-`.", "0.5", "CELL1", kWrongKind},
    {.prefixes = kReal | kCnst, .sign = true, .cell = false, .constant = true, .notGiven = true}};
inline constexpr OperandKind kDefaultValue{
    {"default value", "A constant of the variable's type, or `-`.", "7", "CELL1", kWrongKind},
    {.prefixes = kReal | kCnst, .sign = true, .cell = false, .constant = true, .notGiven = true, .text = true}};
inline constexpr OperandKind kLimitOrLength{
    {"limit or length",
     "A cell of 8 bytes that holds the least value; of TYPE_STR and TYPE_BIN a constant: how many bytes.", "ARRAY",
     "BIT0", kWrongKind},
    {.prefixes = kReal | kCnst, .constant = true, .notGiven = true}};
inline constexpr OperandKind kDeclaration{
    {"declaration", "Part of a declaration: a name, a number, a text; see the instruction."}, {.parse = C::Keyword}};

} // namespace kinds

} // namespace rung::frontend::technol
