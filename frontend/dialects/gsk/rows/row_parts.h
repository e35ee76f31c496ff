// Parts of rows: operands, conditions, shorthands. Included by the rows_*.h only. Texts of rows restate the manual; P
// numbers mark interpretations where it is silent.
#pragma once
#include <string_view>

#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/dialects/gsk/rows/instructions.h"
#include "frontend/dialects/gsk/rows/operand_kinds.h"
#include "frontend/network/lower/functions.h"
#include "frontend/network/rows/row_parts.h"

namespace rung::frontend::gsk {

using namespace network::rows;
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

inline constexpr OperandInfo kSubprogram = {
    .name = "subprogram", .kind = &kinds::kSubprogram, .access = Access::None, .doc = "P1-P512", .min = 1, .max = 512};

inline constexpr PinInfo kRst = {.name = "RST", .doc = "1: the output becomes 0; has priority over ACT (P17)"};

inline constexpr OperandInfo kBitRead = in("bit", kinds::kBit);

} // namespace rung::frontend::gsk
