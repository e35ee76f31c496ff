// The kinds of operands of the rows. A new kind is one descriptor here, and the rows that refer to it.
#pragma once
#include "frontend/dialects/gsk/areas.h"
#include "frontend/network/rows/operand_kinds.h"
#include "ir/support/diag/pmc.h"

namespace rung::frontend::gsk {

using network::Length;
using network::OperandClass;
using network::OperandKind;

namespace kinds {

using namespace network::kinds;

inline constexpr OperandKind kBit{{"bit", "bit address or a declared name", "R10.0", "R10", "bit-address-expected"},
                                  {}};
inline constexpr OperandKind kCoil{
    {"coil", "bit address outside X, F and presets, or a declared name", "R10.0", "X10.0", "write-to-input"}, {}};
inline constexpr OperandKind kByte{{"byte", "byte address or a declared name", "R10", "R10.0", "byte-address-expected"},
                                   {}};
inline constexpr OperandKind kConstant{{"constant",
                                        "decimal or 0x hexadecimal, signed or unsigned, that fits the format", "100",
                                        "0x100000000", "constant-out-of-range"},
                                       {.address = false, .constant = true}};
inline constexpr OperandKind kConstantOrData{
    {"constant-or-data", "constant or address, as the format says", "100", "0x100000000", "constant-out-of-range"},
    {.constant = true, .length = Length::OfFormat}};
inline constexpr OperandKind kMask{{"mask", "four binary digits", "0011", "0012", "bad-mask"},
                                   {.parse = OperandClass::Mask, .written = "{:04b}"}};
inline constexpr OperandKind kSubprogram{{"subprogram", "P1 to P512", "P1", "P513", "parameter-out-of-range"},
                                         {.parse = OperandClass::Named, .written = "P{}"}};
inline constexpr OperandKind kDataTable{
    {"data-table", "address in D", "D10", "R10", "not-a-data-table"},
    {.length = Length::OfFormat, .area = areas::kD, .elsewhere = diag::NotADataTable, .rest = true}};
inline constexpr OperandKind kWorkArea{
    {"work-area", "address of the first of 4 bytes in R", "R10", "D10", "work-area-not-in-r"},
    {.bytes = 4, .area = areas::kR, .elsewhere = diag::WorkAreaNotInR}};

} // namespace kinds

} // namespace rung::frontend::gsk
