// Rules of functions beyond the kinds and ranges of their operands: values, conditions that are constant, the type of
// the PMC, the control beside the program. Rows name them (network::Row::check).
#pragma once
#include "frontend/network/read/context.h"

namespace rung::frontend::fanuc {

void checkAxisGroup(network::Context& context, const network::Network& network);     // of AXCTL
void checkDecodedDigits(network::Context& context, const network::Network& network); // of DEC
void checkPreset(network::Context& context, const network::Network& network);        // of a timer with a fixed preset
void checkCut(network::Context& context, const network::Network& network);           // of constants in BCD

} // namespace rung::frontend::fanuc
