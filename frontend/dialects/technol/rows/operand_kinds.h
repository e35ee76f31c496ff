// The kinds of operands of the rows.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>
#include <variant>

#include "frontend/dialects/technol/records.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::technol {

// The type prefixes that a kind accepts.
enum Prefix : uint8_t { kByte = 1, kWord = 2, kDword = 4, kQword = 8, kHigh = 16, kReal = 32, kCnst = 64 };

// A list of words that an operand may be; `first` is the number of the first word for a device.
struct Words {
  std::string_view list = {}; // separated by blanks
  int64_t first = 0;
};

// The alternatives of an operand kind, besides being left out. Each struct has the properties that apply to it.

// A bit, possibly at an address.
struct BitKind {
  bool sign = false;   // `-` before it
  bool flag = false;   // or the constant 0 or 1
  bool number = false; // or the name of a bit without an address, for its number
};
// A number: in a cell, a constant, or either.
enum class Source : uint8_t { Cell, Constant, Either };
struct NumberKind {
  uint8_t prefixes = 0;
  Source source = Source::Cell;
  bool sign = false;           // `-` before it
  bool text = false;           // or a text
  bool twosComplement = false; // a cell is signed
  ir::TypeSet types = 0xFF;    // of cells
  Words words = {};            // or one of these words
  bool axes = false;           // the words are names of axes, which the configuration may replace
};
// Memory of any type, named by a variable; its type is ignored if there are no prefixes.
struct MemoryKind {
  enum class Content : uint8_t { Any, Text, TextOrLiteral };
  uint8_t prefixes = 0;
  Content content = Content::Any;
  bool pastEnd = false; // also the place after the last byte of its memory
  Words words = {};     // or one of these words
};
// The name of a label, a mechanism or a procedure.
struct NameKind {
  SymbolKind symbol = SymbolKind::Label;
};
// One of several words.
struct WordKind {
  Words words;
};
// A member of a structure of the control, as its offset.
struct MemberKind {
  const char* structure;
};
// A type as a word: one of these prefixes.
struct WidthKind {
  uint8_t prefixes = 0;
  bool bit = false; // or the number of a bit
};
// The register that the row has as its operand.
struct RegisterKind {};
// A variable of MAP_* or DEF_* that the statement declares.
struct NewVariableKind {
  bool array = false; // `[n]` may follow
};
// A variable of DEF_IN, or an element of it.
struct InputKind {};
// The name of a bit, as its number in a byte.
struct BitNumberKind {};
// A part of a declaration, which the reader parses.
struct DeclarationKind {};

using Takes = std::variant<BitKind, NumberKind, MemoryKind, NameKind, WordKind, MemberKind, WidthKind, RegisterKind,
                           NewVariableKind, InputKind, BitNumberKind, DeclarationKind>;

// How an operand may be left out: by `-` or NIL, or also by nothing between commas.
enum class Omission : uint8_t { Never, Dash, Nothing };

struct OperandKind : OperandKindInfo {
  Takes takes;
  Omission omission = Omission::Never;
};

inline const OperandKind& kindOf(const OperandInfo& operand) { return static_cast<const OperandKind&>(*operand.kind); }
inline bool mayBeOmitted(const OperandInfo& operand) { return kindOf(operand).omission != Omission::Never; }
inline bool isMemory(const OperandInfo& operand) { return std::holds_alternative<MemoryKind>(kindOf(operand).takes); }

// Calls visit(word, number) for the words of a list, which are separated by blanks.
template <class Visit>
void forEachWord(std::string_view words, Visit visit) {
  for (int64_t number = 0; !words.empty(); ++number) {
    const size_t end = std::min(words.find(' '), words.size());
    visit(words.substr(0, end), number);
    words.remove_prefix(std::min(end + 1, words.size()));
  }
}
// The number of a word in a list, ignoring case; -1: not in the list.
inline int64_t numberOfWord(std::string_view words, std::string_view wanted) {
  int64_t found = -1;
  forEachWord(words, [&](std::string_view word, int64_t number) {
    if (text::equalsIgnoringCase(wanted, word)) found = number;
  });
  return found;
}

// A new kind is one descriptor here, and the rows that refer to it.
namespace kinds {

// Codes of reports about wrong operands.
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
                                  BitKind{.sign = true}};
inline constexpr OperandKind kPlainBit{
    {"plain bit", "A bit without a sign, also at an address.", "BIT0", "-BIT0", kWrongKind}, BitKind{}};
inline constexpr OperandKind kFlag{{"flag", "0 or 1.", "1", "2", kRange}, NumberKind{.source = Source::Constant}};
inline constexpr OperandKind kSignedValue{
    {"signed value",
     "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL., or a constant (32 bits, or a real with "
     "a decimal point); `-` takes it negative.",
     "CELL1", "BIT0", kWrongKind},
    NumberKind{.prefixes = kCells | kCnst, .source = Source::Either, .sign = true}};
inline constexpr OperandKind kValue{{"value",
                                     "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL., or a "
                                     "constant (32 bits, or a real with a decimal point).",
                                     "CELL1", "BIT0", kWrongKind},
                                    NumberKind{.prefixes = kCells | kCnst, .source = Source::Either}};
inline constexpr OperandKind kNarrowValue{
    {"narrow value", "As a value, but of at most 32 bits: QWRD. is not allowed (man. l.1076).", "CELL1", "QWRD.ARRAY",
     kPrefix},
    NumberKind{.prefixes = kByte | kWord | kHigh | kDword | kReal | kCnst, .source = Source::Either}};
inline constexpr OperandKind kBitwiseValue{
    {"bitwise value", "A cell or constant of at most 32 bits; REAL. and QWRD. are not allowed (man. l.1183).", "CELL1",
     "REAL.ARRAY", kPrefix},
    NumberKind{.prefixes = kByte | kWord | kHigh | kDword | kCnst, .source = Source::Either}};
inline constexpr OperandKind kCell{
    {"cell", "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD. REAL.", "CELL1", "5", kWrongKind},
    NumberKind{.prefixes = kCells}};
inline constexpr OperandKind kIntegerCell{{"integer cell",
                                           "A cell with its own type or a prefix BYTE. WORD. HIGH. DWRD. QWRD.",
                                           "CELL4", "REAL.ARRAY", kPrefix},
                                          NumberKind{.prefixes = kByte | kWord | kHigh | kDword | kQword}};
inline constexpr OperandKind kRealCell{
    {"real cell", "A cell of 8 bytes, also with the prefix REAL.", "ARRAY", "CELL4", kPrefix},
    NumberKind{.prefixes = kReal}};
inline constexpr OperandKind kRealValue{
    {"real value",
     "A cell of 8 bytes, also with the prefix REAL., or a constant, also written CNST.0.2; `-` takes it negative.",
     "0.2", "CELL4", kPrefix},
    NumberKind{.prefixes = kReal | kCnst, .source = Source::Either, .sign = true}};
inline constexpr OperandKind kBitOrFlag{{"bit or flag", "A bit without a sign, 0 or 1.", "1", "2", kRange},
                                        BitKind{.flag = true}};
inline constexpr OperandKind kTimerCell{
    {"timer cell", "A BYTE or WORD cell, or `-` for an automatic one.", "CELL2", "CELL4", kWrongKind},
    NumberKind{.prefixes = kByte | kWord, .types = kShort},
    Omission::Dash};
inline constexpr OperandKind kCounterCell{
    {"counter cell", "A BYTE or WORD cell, without a prefix.", "CELL2", "CELL4", kWrongKind},
    NumberKind{.types = kShort}};
inline constexpr OperandKind kTime{
    {"time", "A constant or a BYTE or WORD cell, in cycles of the PLC (20 ms).", "50", "BIT0", kWrongKind},
    NumberKind{.prefixes = kByte | kWord | kCnst, .source = Source::Either, .types = kShort}};
inline constexpr OperandKind kShiftCount{
    {"shift count", "A constant, or a cell of 8 bits.", "3", "WORD.CELL2", kPrefix},
    NumberKind{.prefixes = kByte | kHigh | kCnst, .source = Source::Either, .types = ir::setOf(ir::Type::I8)}};
inline constexpr OperandKind kConstant{{"constant", "A constant.", "4", "CELL1", kWrongKind},
                                       NumberKind{.prefixes = kCnst, .source = Source::Constant}};
inline constexpr OperandKind kMessageValue{
    {"message value", "A constant or a cell, or `-`.", "12", "BIT0", kWrongKind},
    NumberKind{.prefixes = kByte | kWord | kDword | kCnst, .source = Source::Either},
    Omission::Dash};
inline constexpr OperandKind kMessageNumber{
    {"message number", "A constant or a cell.", "12", "BIT0", kWrongKind},
    NumberKind{.prefixes = kByte | kWord | kDword | kCnst, .source = Source::Either}};
inline constexpr OperandKind kStatusByte{{"status byte",
                                          "The variable that holds the bit, also with an offset (`+n`, `+BX`), or `-`.",
                                          "CELL1", "5", kWrongKind},
                                         MemoryKind{},
                                         Omission::Nothing};
inline constexpr OperandKind kStatusBit{{"status bit", "The name of a bit.", "BIT0", "CELL1", kWrongKind},
                                        BitKind{.number = true}};
inline constexpr OperandKind kMessageSwitch{
    {"message switch", "0, 1 or a cell, or `-`.", "1", "2", kRange},
    NumberKind{.prefixes = kByte | kWord | kDword | kCnst, .source = Source::Either},
    Omission::Dash};
inline constexpr OperandKind kAddress{
    {"address", "A variable, also with an offset; its type does not matter.", "ARRAY", "5", kWrongKind}, MemoryKind{}};
inline constexpr OperandKind kBeginning{
    {"beginning", "A variable, also with an offset, or GLOBAL or INTERNAL before ALL.", "ARRAY", "5", kWrongKind},
    MemoryKind{.words = {.list = "GLOBAL INTERNAL"}}};
inline constexpr OperandKind kEnd{
    {"end", "A variable, also with an offset, or ALL after GLOBAL or INTERNAL.", "ARRAY", "5", kWrongKind},
    MemoryKind{.pastEnd = true, .words = {.list = "ALL"}}};
inline constexpr OperandKind kLength{
    {"length", "A constant, or a BYTE or WORD cell: how many bytes.", "2", "BIT0", kWrongKind},
    NumberKind{.prefixes = kByte | kWord | kCnst, .source = Source::Either, .types = kShort}};
inline constexpr OperandKind kText{{"text", "A text variable, also with an offset.", "TEXT1", "5", kWrongKind},
                                   MemoryKind{.content = MemoryKind::Content::Text}};
inline constexpr OperandKind kTextOrLiteral{
    {"text or literal", "A text variable, also with an offset, or a text in apostrophes.", "'AB'", "5", kWrongKind},
    MemoryKind{.content = MemoryKind::Content::TextOrLiteral}};
inline constexpr OperandKind kWidth{{"width", "DWRD, QWRD or REAL; without it 16 bits.", "DWRD", "BYTE", kPrefix},
                                    WidthKind{.prefixes = kDword | kQword | kReal}};
inline constexpr OperandKind kIntegerWidth{
    {"integer width", "DWRD or QWRD; without it 16 bits.", "QWRD", "REAL", kPrefix},
    WidthKind{.prefixes = kDword | kQword}};
inline constexpr OperandKind kDoubleWidth{{"double width", "DWRD; without it 16 bits.", "DWRD", "QWRD", kPrefix},
                                          WidthKind{.prefixes = kDword}};
inline constexpr OperandKind kBitsOfDr{
    {"bits of DR", "DWRD for 32 bits, or the number 0..31 of one bit; without it 16 bits.", "7", "32", kRange},
    WidthKind{.prefixes = kDword, .bit = true}};
inline constexpr OperandKind kLabel{
    {"label", "A label of the same module, mechanism, procedure or timed block.", "LABEL1", "CELL1", kWrongKind},
    NameKind{.symbol = SymbolKind::Label}};
inline constexpr OperandKind kMechanism{{"mechanism", "The name of a mechanism.", "MECH1", "CELL1", kWrongKind},
                                        NameKind{.symbol = SymbolKind::Mechanism}};
inline constexpr OperandKind kProcedure{{"procedure", "The name of a procedure.", "PROC1", "CELL1", kWrongKind},
                                        NameKind{.symbol = SymbolKind::Procedure}};
inline constexpr OperandKind kRegister{{"register", "BX or CX.", "BX", "AX", "unsupported-assembler"}, RegisterKind{}};
inline constexpr OperandKind kLicence{
    {"licence", "HwKeyConnected, or FeaturePlc0 to FeaturePlc9.", "FeaturePlc1", "CELL1", kWrongKind},
    WordKind{.words = {.list = nc::kLicences}}};
// ---- services -------------------------------------------------------------------------------------------------
inline constexpr OperandKind kNumber{
    {"number", "A constant, or a cell of at most 32 bits.", "1", "BIT0", kWrongKind},
    NumberKind{.prefixes = kNumberPrefixes, .source = Source::Either, .types = kIntegers}};
inline constexpr OperandKind kNumberOrDash{
    {"number or -", "A constant, a cell of at most 32 bits, or `-` where it is not given.", "CELL2", "BIT0",
     kWrongKind},
    NumberKind{.prefixes = kNumberPrefixes, .source = Source::Either, .types = kIntegers},
    Omission::Dash};
inline constexpr OperandKind kSignedOrDash{
    {"signed number or -", "A constant or a cell of at most 32 bits in two's complement, or `-` where it is not given.",
     "CELL2", "BIT0", kWrongKind},
    NumberKind{.prefixes = kNumberPrefixes, .source = Source::Either, .twosComplement = true, .types = kIntegers},
    Omission::Dash};
inline constexpr OperandKind kSignedOrNothing{
    {"signed number or nothing",
     "A constant or a cell of at most 32 bits in two's complement, or `-` or nothing where it is not given.", "CELL2",
     "BIT0", kWrongKind},
    NumberKind{.prefixes = kNumberPrefixes, .source = Source::Either, .twosComplement = true, .types = kIntegers},
    Omission::Nothing};
inline constexpr OperandKind kDistance{
    {"distance", "A cell of 32 bits in two's complement, also with the prefix DWRD.", "CELL4", "CELL2", kWrongKind},
    NumberKind{.prefixes = kDword, .twosComplement = true, .types = ir::setOf(ir::Type::I32)}};
inline constexpr OperandKind kNumberOrNothing{
    {"number or nothing", "A constant, a cell of at most 32 bits, or `-` or nothing where it is not given.", "CELL2",
     "BIT0", kWrongKind},
    NumberKind{.prefixes = kNumberPrefixes, .source = Source::Either, .types = kIntegers},
    Omission::Nothing};
inline constexpr OperandKind kAxis{{"axis",
                                    "A constant, a cell of at most 32 bits, or the name of an axis, one of X Y Z C A B "
                                    "U V W, which are 1 to 9, or of the letters of `config axes`, which are 1 and on "
                                    "(man. l.8018, l.8052, l.8302).",
                                    "4", "17", kRange},
                                   NumberKind{.prefixes = kNumberPrefixes,
                                              .source = Source::Either,
                                              .types = kIntegers,
                                              .words = {.list = "X Y Z C A B U V W", .first = 1},
                                              .axes = true}};
inline constexpr OperandKind kSpindle{
    {"spindle", "0 none, 1 main, 2 assistant, or S: as SPI_MAIN has set it (man. l.7984).", "S", "3", kRange},
    NumberKind{.prefixes = kNumberPrefixes,
               .source = Source::Either,
               .types = kIntegers,
               .words = {.list = nc::technol::kSpindleWords, .first = nc::technol::kFirstSpindleWord}}};
inline constexpr OperandKind kByteCell{
    {"byte cell", "A cell of 8 bits, also with the prefix BYTE.", "CELL1", "CELL4", kWrongKind},
    NumberKind{.prefixes = kByte | kHigh, .types = ir::setOf(ir::Type::I8)}};
inline constexpr OperandKind kWordCell{
    {"word cell", "A cell of 16 bits, also with the prefix WORD.", "CELL2", "CELL4", kWrongKind},
    NumberKind{.prefixes = kWord, .types = ir::setOf(ir::Type::I16)}};
inline constexpr OperandKind kDwordCell{
    {"dword cell", "A cell of 32 bits, also with the prefix DWRD.", "CELL4", "CELL2", kWrongKind},
    NumberKind{.prefixes = kDword, .types = ir::setOf(ir::Type::I32)}};
inline constexpr OperandKind kCellOrText{
    {"cell or text", "A variable or a text, also with an offset or a prefix.", "CELL4", "5", kWrongKind},
    MemoryKind{.prefixes = kCells}};
inline constexpr OperandKind kRealOrText{{"real or text",
                                          "A variable of 8 bytes or a text, also with an offset or the prefix REAL.",
                                          "RATIO", "5", kWrongKind},
                                         MemoryKind{.prefixes = kReal}};
inline constexpr OperandKind kBitOrNothing{{"bit or nothing",
                                            "A bit without a sign, or `-`, NIL or nothing where it is not given.",
                                            "BIT0", "CELL1", kWrongKind},
                                           BitKind{},
                                           Omission::Nothing};
inline constexpr OperandKind kItemOfAUnit{
    {"item of a unit", "A member of the structure INOUTS.", "ANL0", "4", kWrongKind},
    MemberKind{.structure = "INOUTS"}};
inline constexpr OperandKind kLineCommand{
    {"line command", "CLEAR, RECEIVED or STATE.", "STATE", "4", kWrongKind},
    WordKind{.words = {.list = nc::technol::kLineCommandWords, .first = nc::technol::kFirstLineCommand}}};
inline constexpr OperandKind kNewBit{{"new bit", "The name of the bit that is declared.", "NEW1", "5", kWrongKind},
                                     NewVariableKind{}};
inline constexpr OperandKind kNewReal{
    {"new real", "The name of the cell that is declared, a real.", "NEW1", "5", kWrongKind}, NewVariableKind{}};
inline constexpr OperandKind kNewVariable{
    {"new variable",
     "The name of the variable that is declared; with `[n]` an array of n elements or a text of n characters.", "NEW1",
     "5", kWrongKind},
    NewVariableKind{.array = true}};
inline constexpr OperandKind kLogicalInput{
    {"logical input", "The name of a variable of DEF_IN, with `[i]` one element.", "INPUT1", "CELL1", kWrongKind},
    InputKind{}};
inline constexpr OperandKind kBitName{
    {"name of a bit", "The name of a bit, used as its number in a byte.", "BIT0", "CELL1", kWrongKind},
    BitNumberKind{}};
inline constexpr OperandKind kType{
    {"type",
     "TYPE_BIT, TYPE_INT_8, TYPE_UNS_8 or TYPE_BYTE, TYPE_INT_16, TYPE_UNS_16 or TYPE_WORD, TYPE_INT_32, TYPE_UNS_32 "
     "or TYPE_DWORD, TYPE_INT_64, TYPE_UNS_64 or TYPE_QWORD, TYPE_REAL, TYPE_STR, TYPE_BIN.",
     "TYPE_DWORD", "5", kWrongKind},
    WordKind{.words = {.list = nc::kExchangeTypeWords}}};
inline constexpr OperandKind kFast{{"FAST", "FAST: served every millisecond.", "FAST", "5", kWrongKind},
                                   WordKind{.words = {.list = "FAST"}},
                                   Omission::Dash};
inline constexpr OperandKind kPeriod{
    {"period", "SLOW, FAST, FASTEST or ONDEMAND; without it SLOW.", "ONDEMAND", "5", kWrongKind},
    WordKind{.words = {.list = nc::kExchangePeriodWords}},
    Omission::Dash};
inline constexpr OperandKind kDefaultBit{{"default bit", "0 or 1, or `-`.", "1", "2", kRange},
                                         NumberKind{.prefixes = kCnst, .source = Source::Constant},
                                         Omission::Dash};
inline constexpr OperandKind kDefaultReal{
    {"default real", "A real constant with its decimal point, or `-`.", "0.5", "CELL1", kWrongKind},
    NumberKind{.prefixes = kReal | kCnst, .source = Source::Constant, .sign = true},
    Omission::Dash};
inline constexpr OperandKind kDefaultValue{
    {"default value", "A constant of the variable's type, or `-`.", "7", "CELL1", kWrongKind},
    NumberKind{.prefixes = kReal | kCnst, .source = Source::Constant, .sign = true, .text = true},
    Omission::Dash};
inline constexpr OperandKind kLimitOrLength{
    {"limit or length",
     "A cell of 8 bytes that holds the least value; of TYPE_STR and TYPE_BIN a constant: how many bytes.", "ARRAY",
     "BIT0", kWrongKind},
    NumberKind{.prefixes = kReal | kCnst, .source = Source::Either},
    Omission::Dash};
inline constexpr OperandKind kDeclaration{
    {"declaration", "Part of a declaration: a name, a number, a text; see the instruction."}, DeclarationKind{}};

} // namespace kinds

} // namespace rung::frontend::technol
