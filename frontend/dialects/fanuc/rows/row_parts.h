// Parts of rows: operands, conditions, shorthands. Included by the rows_*.h only. `ref` is the section of the inventory
// and the certainty of its sources.
#pragma once
#include <string_view>

#include "frontend/dialects/fanuc/check/functions.h"
#include "frontend/dialects/fanuc/lower/lower.h"
#include "frontend/dialects/fanuc/rows/instructions.h"
#include "frontend/dialects/fanuc/rows/operand_kinds.h"
#include "frontend/network/lower/functions.h"
#include "frontend/network/rows/row_parts.h"

namespace rung::frontend::fanuc {

using namespace network::rows;
using network::Control;

inline constexpr OperandInfo kFormatN = {.name = "format",
                                         .kind = &kinds::kFormatN,
                                         .access = Access::None,
                                         .doc = "number of elements, and their length in bytes"};
inline constexpr OperandInfo kSubprogram = {.name = "subprogram",
                                            .kind = &kinds::kSubprogram,
                                            .access = Access::None,
                                            .doc = "P1-P5000",
                                            .min = 1,
                                            .max = 5000};

inline constexpr PinInfo kRst = {.name = "RST", .doc = "1: W1 becomes 0; has priority over ACT"};
inline constexpr PinInfo kByt = {.name = "BYT", .doc = "0 two BCD digits in a byte, 1 four in two bytes"};

inline constexpr OperandInfo kBitRead = in("bit", kinds::kBit);

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
constexpr Row withCheck(Row row, void (*check)(network::Context& context, const network::Network& network)) {
  row.check = check;
  return row;
}
// Moves between a table and a place; the condition with this index is 0 to read the table and 1 to write it.
constexpr Row withDirection(Row row, int8_t condition) {
  row.direction = condition;
  return row;
}
// The condition with this index is BYT.
constexpr Row withWidth(Row row, int8_t condition) {
  row.wide = condition;
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
