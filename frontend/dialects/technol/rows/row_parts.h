// Operands that several rows share. Included by the rows_*.h only.
#pragma once
#include <string_view>

#include "frontend/dialects/technol/rows/instructions.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"

namespace rung::frontend::technol {

using OperandList = decltype(InstructionInfo::operands);

// Most bytes that one instruction may move: limited by the iterations of a rung.
inline constexpr int64_t kMostBytes = int64_t{1} << 20;

constexpr OperandInfo in(std::string_view name, const OperandKind& kind, std::string_view doc) {
  return {.name = name, .kind = &kind, .doc = doc};
}
constexpr OperandInfo out(std::string_view name, const OperandKind& kind, std::string_view doc) {
  return {.name = name, .kind = &kind, .access = Access::Write, .doc = doc};
}
constexpr OperandInfo inout(std::string_view name, const OperandKind& kind, std::string_view doc) {
  return {.name = name, .kind = &kind, .access = Access::ReadWrite, .doc = doc};
}
constexpr OperandInfo ranged(OperandInfo operand, int64_t min, int64_t max) {
  operand.min = min;
  operand.max = max;
  return operand;
}
constexpr OperandInfo optional(OperandInfo operand) {
  operand.optional = true;
  return operand;
}
constexpr OperandInfo repeated(OperandInfo operand) {
  operand.repeated = true;
  return operand;
}
constexpr OperandInfo lengthOf(std::string_view name, std::string_view doc, bool optional) {
  return {.name = name, .kind = &kinds::kLength, .doc = doc, .min = 0, .max = kMostBytes, .optional = optional};
}
// Where instructions of EX kind are allowed (man. l.2166-2171).
inline constexpr std::string_view kSequentialUnits = "mechanisms, MODULE_BLOCK_INIT, MODULE_BLOCK_DONE";
// The part of DR that the instruction uses.
constexpr OperandInfo widthOf(const OperandKind& kind) {
  return optional(in("width", kind, "the part of DR; without it 16 bits"));
}

} // namespace rung::frontend::technol
