// Parts of rows that all languages of the family have: operands, conditions, shorthands. Included by the row_parts.h of
// a dialect only.
#pragma once
#include <string_view>

#include "frontend/network/lower/lowered_row.h"
#include "frontend/network/rows/operand_kinds.h"

namespace rung::frontend::network::rows {

using frontend::Access;
using frontend::OperandInfo;
using frontend::Output;
using frontend::PinInfo;
using frontend::Placement;
using OperandList = decltype(frontend::InstructionInfo::operands);
using PinList = decltype(frontend::InstructionInfo::pins);

constexpr OperandInfo in(std::string_view name, const OperandKind& kind, std::string_view doc = {}) {
  return {.name = name, .kind = &kind, .access = Access::Read, .doc = doc};
}
constexpr OperandInfo out(std::string_view name, const OperandKind& kind, std::string_view doc = {}) {
  return {.name = name, .kind = &kind, .access = Access::Write, .doc = doc};
}
constexpr OperandInfo inout(std::string_view name, const OperandKind& kind, std::string_view doc = {}) {
  return {.name = name, .kind = &kind, .access = Access::ReadWrite, .doc = doc};
}
constexpr OperandInfo number(std::string_view name, int64_t min, int64_t max, std::string_view doc = {}) {
  return {.name = name, .kind = &kinds::kNumber, .access = Access::None, .doc = doc, .min = min, .max = max};
}
constexpr OperandInfo record(std::string_view name, Access access, std::string_view doc) {
  return {.name = name, .kind = &kinds::kRecord, .access = access, .doc = doc};
}
inline constexpr OperandInfo kFormat = {
    .name = "format", .kind = &kinds::kFormat, .access = Access::None, .doc = "length in bytes"};
inline constexpr OperandInfo kFormatA = {.name = "format",
                                         .kind = &kinds::kFormatA,
                                         .access = Access::None,
                                         .doc = "constant or address, and length in bytes"};
inline constexpr OperandInfo kLabel = {
    .name = "label", .kind = &kinds::kLabel, .access = Access::None, .doc = "L1-L9999", .min = 1, .max = 9999};

inline constexpr PinInfo kAct = {.name = "ACT", .doc = "1: execute"};
inline constexpr PinInfo kCn0 = {.name = "CN0", .doc = "numbers begin with 0 or 1"};
inline constexpr PinInfo kUpDown = {.name = "UPDOWN", .doc = "0 up, 1 down"};
inline constexpr PinInfo kCount = {.name = "ACT", .doc = "counts at its rising edge", .edge = true};

// A basic instruction; without an operand, `operand` is {}.
constexpr LoweredRow basic(std::string_view mnemonic, std::string_view title, OperandInfo operand, std::string_view ref,
                           std::string_view doc) {
  LoweredRow row;
  row.info.mnemonic = mnemonic;
  row.info.title = title;
  row.info.group = isWritten(operand.access) ? "coils" : "contacts";
  if (!operand.name.empty()) row.info.operands = {operand};
  row.info.placement = Placement::Anywhere;
  row.info.ref = ref;
  row.info.doc = doc;
  return row;
}

// The same as frontend::rowOf for functions, which have numbers.
constexpr LoweredRow rowOf(LoweredRow shape, int number, std::string_view mnemonic, std::string_view title,
                           std::string_view ref, std::string_view doc, std::string_view example, int variant = 0) {
  shape.info.number = number;
  return frontend::rowOf(shape, mnemonic, title, ref, doc, example, variant);
}

} // namespace rung::frontend::network::rows
