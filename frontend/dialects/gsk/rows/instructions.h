// The instruction table of the dialect: one row per instruction, with its lowering. All data about an instruction is
// only here; README.md says how to add one.
#pragma once
#include <span>
#include <string_view>

#include "frontend/network/lower/lowered_row.h"

namespace rung::frontend::gsk {

using Row = network::LoweredRow;
using network::LowerFn;

std::span<const Row> allRows();
// The data of a box's row without its lowering; null for any other word.
const frontend::InstructionInfo* findBox(std::string_view mnemonic);

// Pointers to all rows.
std::span<const network::Row* const> networkRows();
std::span<const frontend::InstructionInfo* const> instructionInfos();

} // namespace rung::frontend::gsk
