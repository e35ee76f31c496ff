// The kinds of operands of the rows. A new kind is one descriptor here, and the rows that refer to it.
#pragma once
#include "frontend/network/rows/operand_kinds.h"
#include "ir/support/diag/pmc.h"

namespace rung::frontend::fanuc {

using network::Length;
using network::OperandClass;
using network::OperandKind;

namespace kinds {

using namespace network::kinds;

inline constexpr OperandKind kBit{{"bit", "bit address or symbol", "R10.0", "R10", "bit-address-expected"}, {}};
inline constexpr OperandKind kCoil{
    {"coil", "bit address or symbol outside X, F and M", "R10.0", "X10.0", "write-to-input"}, {}};
inline constexpr OperandKind kFormatN{{"format-n",
                                       "0nnf: nn elements (00 and 01: one) of f = 1, 2 or 4 bytes; f alone means 000f",
                                       "0022", "0023", "bad-format"},
                                      {.parse = OperandClass::Format, .counts = true, .written = "{:04}"}};
inline constexpr OperandKind kChoice{{"format-01", "0 a constant, 1 an address", "0", "2", "bad-format"},
                                     {.parse = OperandClass::Format, .chooses = true}};
// BCD data: of two digits in one byte the second byte is not used.
inline constexpr OperandKind kDigits{{"digits",
                                      "address of two BCD digits in a byte, or of four in two bytes, as BYT says",
                                      "R10", "R10.0", "byte-address-expected"},
                                     {.length = Length::OfDigits, .least = 1}};
inline constexpr OperandKind kDigitTable{
    {"digit-table", "address of the first of as many such BCD numbers as the function has elements", "D10", "D10.0",
     "byte-address-expected"},
    {.length = Length::OfDigitTable, .least = 1}};
inline constexpr OperandKind kNumberOrDigits{
    {"number-or-digits", "constant 0 to 9999 or address, as the format says", "100", "10000", "parameter-out-of-range"},
    {.constant = true, .length = Length::OfDigits, .least = 1}};
inline constexpr OperandKind kByte{{"byte", "byte address or symbol", "R10", "R10.0", "byte-address-expected"}, {}};
inline constexpr OperandKind kElements{
    {"elements", "address of the first of as many elements as the format says", "R10", "R9999", "address-out-of-range"},
    {.length = Length::OfElements}};
inline constexpr OperandKind kBytes{
    {"bytes", "address of the first of as many bytes as the format counts", "R10", "R9999", "address-out-of-range"},
    {.length = Length::OfCount}};
inline constexpr OperandKind kConstant{{"constant",
                                        "decimal number, signed or unsigned; of one that does not fit the "
                                        "format the low bytes count",
                                        "100", "UNDECLARED", "undefined-symbol"},
                                       {.address = false, .constant = true}};
inline constexpr OperandKind kConstantOrData{
    {"constant-or-data", "constant or address, as the format says", "100", "UNDECLARED", "undefined-symbol"},
    {.constant = true, .length = Length::OfFormat}};
inline constexpr OperandKind kEitherByte{
    {"value-1", "constant, or address of a byte", "100", "UNDECLARED", "undefined-symbol"},
    {.constant = true, .either = true}};
inline constexpr OperandKind kEitherWord{
    {"value-2", "constant, or address of the first of 2 bytes", "100", "UNDECLARED", "undefined-symbol"},
    {.constant = true, .either = true, .bytes = 2}};
inline constexpr OperandKind kEitherDword{
    {"value-4", "constant, or address of the first of 4 bytes", "100", "UNDECLARED", "undefined-symbol"},
    {.constant = true, .either = true, .bytes = 4}};
inline constexpr OperandKind kMask{{"mask", "one to four binary digits", "0011", "0012", "bad-mask"},
                                   {.parse = OperandClass::Mask, .digits = 1, .written = "{:04b}"}};
inline constexpr OperandKind kSubprogram{
    {"subprogram", "P1 to P5000, or a symbol of one", "P1", "P5001", "parameter-out-of-range"},
    {.parse = OperandClass::Named, .written = "P{}"}};
inline constexpr OperandKind kTable{
    {"table", "address of the first element of a table", "D10", "D10.0", "byte-address-expected"},
    {.length = Length::OfFormat, .rest = true}};

} // namespace kinds

} // namespace rung::frontend::fanuc
