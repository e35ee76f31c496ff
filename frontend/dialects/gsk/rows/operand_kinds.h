// Kinds of operands: what a row may ask for. A new kind is one descriptor here, and the rows that name it.
#pragma once
#include <optional>

#include "frontend/dialects/gsk/read/address.h"
#include "frontend/table/instruction.h"
#include "ir/support/diagnostics.h"

namespace rung::gsk {

// How the word of an operand is read.
enum class OperandClass : uint8_t { Value, Number, Mask, Named, Format };
// What says how many bytes there are at an address.
enum class Length : uint8_t { OfKind, OfFormat, OfNumber, OfRow };

struct OperandTraits {
  OperandClass parse = OperandClass::Value;
  bool address = true;               // Value: an address may be written
  bool constant = false;             // Value: a constant may; where both may the format says which
  Length length = Length::OfKind;    // of an address
  uint32_t bytes = 1;                // of an address, with OfKind
  std::optional<Area> area = {};     // of an address: the only one that is allowed
  Diag elsewhere = Diag::BadOperand; // it is in another area
  bool rest = false;                 // of an address: all that follows in its area may be meant
  bool selects = false;              // Format: says whether it is a constant or an address
  std::string_view written = "{}";   // how a value is written; Named begins with its letter
};

struct OperandKind : frontend::OperandKindInfo, OperandTraits {};

inline const OperandKind& kindOf(const frontend::OperandInfo& operand) {
  return static_cast<const OperandKind&>(*operand.kind);
}

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
    {.length = Length::OfFormat, .area = Area::D, .elsewhere = Diag::NotADataTable, .rest = true}};
inline constexpr OperandKind kWorkArea{
    {"work-area", "address of the first of 4 bytes in R", "R10", "D10", "work-area-not-in-r"},
    {.bytes = 4, .area = Area::R, .elsewhere = Diag::WorkAreaNotInR}};
inline constexpr OperandKind kRecord{{"record", "address of the first of as many bytes as the instruction's block has",
                                      "R10", "R1098", "address-out-of-range"},
                                     {.length = Length::OfRow}};

} // namespace kinds

} // namespace rung::gsk
