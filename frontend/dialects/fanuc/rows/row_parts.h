// Parts of rows: operands, conditions, shorthands. Included by the rows_*.h only. `ref` is the section of the inventory
// and the certainty of its sources.
#pragma once
#include <string_view>

#include "frontend/dialects/fanuc/check/operands.h"
#include "frontend/dialects/fanuc/lower/lower.h"
#include "frontend/dialects/fanuc/rows/instructions.h"
#include "frontend/dialects/fanuc/rows/operand_kinds.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::fanuc {

using frontend::Access;
using frontend::OperandInfo;
using frontend::Output;
using frontend::PinInfo;
using frontend::Placement;
using network::Control;
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
inline constexpr OperandInfo kFormatN = {.name = "format",
                                         .kind = &kinds::kFormatN,
                                         .access = Access::None,
                                         .doc = "number of elements, and their length in bytes"};
inline constexpr OperandInfo kLabel = {
    .name = "label", .kind = &kinds::kLabel, .access = Access::None, .doc = "L1-L9999", .min = 1, .max = 9999};
inline constexpr OperandInfo kSubprogram = {.name = "subprogram",
                                            .kind = &kinds::kSubprogram,
                                            .access = Access::None,
                                            .doc = "P1-P5000",
                                            .min = 1,
                                            .max = 5000};

inline constexpr PinInfo kAct = {.name = "ACT", .doc = "1: execute"};
inline constexpr PinInfo kRst = {.name = "RST", .doc = "1: W1 becomes 0; has priority over ACT"};
inline constexpr PinInfo kByt = {.name = "BYT", .doc = "0 two BCD digits in a byte, 1 four in two bytes"};
inline constexpr PinInfo kCn0 = {.name = "CN0", .doc = "numbers begin with 0 or 1"};
inline constexpr PinInfo kUpDown = {.name = "UPDOWN", .doc = "0 up, 1 down"};
inline constexpr PinInfo kCount = {.name = "ACT", .doc = "counts at its rising edge", .edge = true};

inline constexpr OperandInfo kBitRead = in("bit", kinds::kBit);

constexpr Row basic(std::string_view mnemonic, std::string_view title, OperandInfo operand, std::string_view doc) {
  Row row;
  row.info.mnemonic = mnemonic;
  row.info.title = title;
  row.info.group = operand.access == Access::Write || operand.access == Access::ReadWrite ? "coils" : "contacts";
  if (!operand.name.empty()) row.info.operands = {operand};
  row.info.placement = Placement::Anywhere;
  row.info.ref = "4.1, high";
  row.info.doc = doc;
  return row;
}

// The same as frontend::rowOf for functions, which have numbers.
constexpr Row rowOf(Row shape, int number, std::string_view mnemonic, std::string_view title, std::string_view ref,
                    std::string_view doc, std::string_view example, int variant = 0) {
  shape.info.number = number;
  return frontend::rowOf(shape, mnemonic, title, ref, doc, example, variant);
}

// A function whose output is copied by the coils after it.
constexpr Row withOutput(std::string_view group, PinList pins, OperandList operands, LowerFn lower) {
  return {{.info = {.group = group, .pins = pins, .operands = operands, .output = Output::Always, .stateful = true}},
          lower};
}
// The rows of a table follow the parameters, the number of rows is the second one.
constexpr Row withTable(Row row) {
  row.hasTable = true;
  return row;
}
constexpr Row withCheck(Row row, void (*check)(const network::Function& function, Diagnostics& diagnostics)) {
  row.check = check;
  return row;
}
// Numbers of variable timers and counters are as many as their areas hold (inventory §3.3).
constexpr Row withPlaces(Row row, Row::Places places) {
  row.places = places;
  return row;
}
// A function without an output: coils after it take ACT (inventory §5.2).
constexpr Row withoutOutput(std::string_view group, OperandList operands, LowerFn lower) {
  return {{.info = {.group = group, .pins = {kAct}, .operands = operands, .output = Output::Optional}}, lower};
}

} // namespace rung::frontend::fanuc
