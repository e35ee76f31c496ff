// The instruction table of the dialect: one row an instruction, with its lowering. Everything that is data about an
// instruction is here only; README.md says how to add one.
#pragma once
#include <span>
#include <string_view>

#include "frontend/network/lower/lowered_row.h"

namespace rung::frontend::gsk {

using Row = network::LoweredRow;
using network::LowerFn;

std::span<const Row> allRows();
// The data alone of a box's row; null when there is none.
const frontend::InstructionInfo* findBox(std::string_view mnemonic);

// All rows, by pointers.
std::span<const network::Row* const> networkRows();
std::span<const frontend::InstructionInfo* const> instructionInfos();

} // namespace rung::frontend::gsk
