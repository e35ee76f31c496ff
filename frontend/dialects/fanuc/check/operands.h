// Checks of operands beyond their kind and range, which rows name.
#pragma once
#include "frontend/network/program.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend::fanuc {

void checkAxisGroup(const network::Function& function, Diagnostics& diagnostics);
void checkDecodedDigits(const network::Function& function, Diagnostics& diagnostics);

} // namespace rung::frontend::fanuc
