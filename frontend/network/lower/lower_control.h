// Lowering of the instructions that shape the program.
#pragma once
#include "frontend/network/lower/lower_function.h"

namespace rung::frontend::network {

void lowerMark(Lowering& f);
void lowerEnd(Lowering& f);
void lowerJump(Lowering& f);
void lowerCall(Lowering& f);
void lowerLeave(Lowering& f);
void lowerCommonLine(Lowering& f);

} // namespace rung::frontend::network
