// Lowering of the instructions that shape the program.
#pragma once
#include "frontend/network/lower/lower_function.h"

namespace rung::network {

void lowerMark(FunctionLowering& f);
void lowerEnd(FunctionLowering& f);
void lowerJump(FunctionLowering& f);
void lowerCall(FunctionLowering& f);
void lowerLeave(FunctionLowering& f);
void lowerCommonLine(FunctionLowering& f);

} // namespace rung::network
