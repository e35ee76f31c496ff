// The kinds of operands of the rows. A new kind is one descriptor here, and the rows that refer to it.
#pragma once
#include "frontend/dialects/gsk/areas.h"
#include "frontend/network/operand_kind.h"
#include "ir/support/diag/pmc.h"

namespace rung::frontend::gsk {

using network::Length;
using network::OperandClass;
using network::OperandKind;

namespace kinds {

inline constexpr OperandKind kBit{{"bit", "bit address or a declared name", "R10.0", "R10", "bit-address-expected"},
                                  {}};
inline constexpr OperandKind kCoil{
    {"coil", "bit address outside X, F and presets, or a declared name", "R10.0", "X10.0", "write-to-input"}, {}};
inline constexpr OperandKind kFormat{{"format", "1, 2 or 4, with any leading zeros", "2", "3", "bad-format"},
                                     {.parse = OperandClass::Format}};
inline constexpr OperandKind kFormatA{{"format-a",
                                       "a00n: a 0 constant or 1 address, n 1, 2 or 4 bytes; n alone means 000n", "0002",
                                       "0003", "bad-format"},
                                      {.parse = OperandClass::Format, .selects = true, .written = "{:04}"}};
inline constexpr OperandKind kByte{{"byte", "byte address or a declared name", "R10", "R10.0", "byte-address-expected"},
                                   {}};
inline constexpr OperandKind kWord{{"word", "address of the first of 2 bytes", "R10", "R1099", "address-out-of-range"},
                                   {.bytes = 2}};
inline constexpr OperandKind kDword{
    {"dword", "address of the first of 4 bytes", "R10", "R1097", "address-out-of-range"}, {.bytes = 4}};
inline constexpr OperandKind kData{
    {"data", "address of the first of as many bytes as the format says", "R10", "R2000", "address-out-of-range"},
    {.length = Length::OfFormat}};
inline constexpr OperandKind kBlock{
    {"block", "address of the first byte of the block", "R10", "R2000", "address-out-of-range"},
    {.length = Length::OfNumber}};
inline constexpr OperandKind kConstant{{"constant",
                                        "decimal or 0x hexadecimal, signed or unsigned, that fits the format", "100",
                                        "0x100000000", "constant-out-of-range"},
                                       {.address = false, .constant = true}};
inline constexpr OperandKind kConstantOrData{
    {"constant-or-data", "constant or address, as the format says", "100", "0x100000000", "constant-out-of-range"},
    {.constant = true, .length = Length::OfFormat}};
inline constexpr OperandKind kNumber{
    {"number", "decimal number in the range of the instruction", "1", "-1", "parameter-out-of-range"},
    {.parse = OperandClass::Number}};
inline constexpr OperandKind kMask{{"mask", "four binary digits", "0011", "0012", "bad-mask"},
                                   {.parse = OperandClass::Mask, .written = "{:04b}"}};
inline constexpr OperandKind kLabel{{"label", "L1 to L9999", "L1", "L10000", "parameter-out-of-range"},
                                    {.parse = OperandClass::Named, .written = "L{}"}};
inline constexpr OperandKind kSubprogram{{"subprogram", "P1 to P512", "P1", "P513", "parameter-out-of-range"},
                                         {.parse = OperandClass::Named, .written = "P{}"}};
inline constexpr OperandKind kDataTable{
    {"data-table", "address in D", "D10", "R10", "not-a-data-table"},
    {.length = Length::OfFormat, .area = areas::kD, .elsewhere = diag::NotADataTable, .rest = true}};
inline constexpr OperandKind kWorkArea{
    {"work-area", "address of the first of 4 bytes in R", "R10", "D10", "work-area-not-in-r"},
    {.bytes = 4, .area = areas::kR, .elsewhere = diag::WorkAreaNotInR}};
inline constexpr OperandKind kRecord{{"record", "address of the first of as many bytes as the instruction's block has",
                                      "R10", "R1098", "address-out-of-range"},
                                     {.length = Length::OfRow}};

} // namespace kinds

} // namespace rung::frontend::gsk
