// The instructions: rows of data. What is known of an instruction is in its row, or in the lowering function that the
// row names. README.md says how one is added.
#pragma once
#include <span>
#include <string_view>

#include "frontend/network/lower/lowered_row.h"

namespace rung::frontend::fanuc {

using Row = network::LoweredRow;
using network::LowerFn;

std::span<const Row> allRows();
// The data of a box's row without its lowering; null for any other word.
const frontend::InstructionInfo* findBox(std::string_view mnemonic);

// Pointers to all rows.
std::span<const network::Row* const> networkRows();
std::span<const frontend::InstructionInfo* const> instructionInfos();

} // namespace rung::frontend::fanuc
