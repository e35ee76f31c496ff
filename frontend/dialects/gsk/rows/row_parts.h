// Parts of rows: operands, conditions, shorthands. Included by the rows_*.h only. Texts of rows restate the manual; P
// numbers mark interpretations where it is silent.
#pragma once
#include <string_view>

#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/dialects/gsk/rows/instructions.h"
#include "frontend/dialects/gsk/rows/operand_kinds.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::gsk {

using frontend::Access;
using frontend::OperandInfo;
using frontend::Output;
using frontend::PinInfo;
using frontend::Placement;
using network::Control;
using network::lowerArithmetic;
using network::lowerBcd;
using network::lowerCall;
using network::lowerCodeTable;
using network::lowerCommonLine;
using network::lowerDecode;
using network::lowerDivision;
using network::lowerEdge;
using network::lowerEnd;
using network::lowerIndexedMove;
using network::lowerJump;
using network::lowerLeave;
using network::lowerLogic;
using network::lowerMark;
using network::lowerMove;
using network::lowerMoveBlock;
using network::lowerMoveMasked;
using network::lowerMoveOr;
using network::lowerNot;
using network::lowerNumber;
using network::lowerParity;
using network::lowerRotation;
using network::lowerSearch;
using network::lowerShift;
using OperandList = decltype(frontend::InstructionInfo::operands);

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
inline constexpr OperandInfo kSubprogram = {
    .name = "subprogram", .kind = &kinds::kSubprogram, .access = Access::None, .doc = "P1-P512", .min = 1, .max = 512};

inline constexpr PinInfo kAct = {.name = "ACT", .doc = "1: execute"};
inline constexpr PinInfo kRst = {.name = "RST", .doc = "1: the output becomes 0; has priority over ACT (P17)"};
inline constexpr PinInfo kCn0 = {.name = "CN0", .doc = "numbers begin with 0 or 1"};
inline constexpr PinInfo kUpDown = {.name = "UPDOWN", .doc = "0 up, 1 down"};
inline constexpr PinInfo kCount = {.name = "ACT", .doc = "counts at its rising edge", .edge = true};

constexpr Row basic(std::string_view mnemonic, std::string_view title, OperandInfo operand, std::string_view ref,
                    std::string_view doc) {
  Row row;
  row.info.mnemonic = mnemonic;
  row.info.title = title;
  row.info.group = operand.access == Access::Write || operand.access == Access::ReadWrite ? "coils" : "contacts";
  if (!operand.name.empty()) row.info.operands = {operand};
  row.info.placement = Placement::Anywhere;
  row.info.ref = ref;
  row.info.doc = doc;
  return row;
}

// The same as frontend::rowOf for functions, which have numbers.
constexpr Row rowOf(Row shape, int number, std::string_view mnemonic, std::string_view title, std::string_view ref,
                    std::string_view doc, std::string_view example, int variant = 0) {
  shape.info.number = number;
  return frontend::rowOf(shape, mnemonic, title, ref, doc, example, variant);
}
inline constexpr OperandInfo kBitRead = in("bit", kinds::kBit);

} // namespace rung::frontend::gsk
