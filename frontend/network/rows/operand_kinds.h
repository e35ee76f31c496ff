// Kinds of operands that all languages of the family have. A dialect adds its own (DIALECT/rows/operand_kinds.h).
#pragma once
#include "frontend/network/operand_kind.h"

namespace rung::frontend::network::kinds {

inline constexpr OperandKind kFormat{{"format", "1, 2 or 4, with any leading zeros", "2", "3", "bad-format"},
                                     {.parse = OperandClass::Format}};
inline constexpr OperandKind kFormatA{{"format-a",
                                       "a00n: a 0 constant or 1 address, n 1, 2 or 4 bytes; n alone means 000n", "0002",
                                       "0003", "bad-format"},
                                      {.parse = OperandClass::Format, .selects = true, .written = "{:04}"}};
inline constexpr OperandKind kWord{{"word", "address of the first of 2 bytes", "R10", "R10.0", "byte-address-expected"},
                                   {.bytes = 2}};
inline constexpr OperandKind kDword{
    {"dword", "address of the first of 4 bytes", "R10", "R10.0", "byte-address-expected"}, {.bytes = 4}};
inline constexpr OperandKind kData{
    {"data", "address of the first of as many bytes as the format says", "R10", "R9999", "address-out-of-range"},
    {.length = Length::OfFormat}};
inline constexpr OperandKind kBlock{
    {"block", "address of the first byte of the block", "R10", "R9999", "address-out-of-range"},
    {.length = Length::OfNumber}};
inline constexpr OperandKind kNumber{
    {"number", "decimal number in the range of the instruction", "1", "-1", "parameter-out-of-range"},
    {.parse = OperandClass::Number}};
inline constexpr OperandKind kLabel{{"label", "L1 to L9999", "L1", "L10000", "parameter-out-of-range"},
                                    {.parse = OperandClass::Named, .written = "L{}"}};
inline constexpr OperandKind kRecord{{"record", "address of the first of as many bytes as the instruction's block has",
                                      "R10", "R9999", "address-out-of-range"},
                                     {.length = Length::OfRow}};

} // namespace rung::frontend::network::kinds
