// The instruction table of the dialect: one row an instruction, with its lowering. Everything that is data about an
// instruction is here only; README.md says how to add one.
#pragma once
#include <span>
#include <string_view>

#include "frontend/network/row.h"

namespace rung::gsk {

class Lowering;

using LowerFn = void (*)(Lowering& f);

struct Row : network::Row {
  LowerFn lower = nullptr; // null: known, but not built
  int variant = 0;         // for `lower`
};

std::span<const Row> allRows();
// The row of a function that a program names.
inline const Row& rowOf(const network::Row& row) { return static_cast<const Row&>(row); }
// The data alone of a box's row; null when there is none.
const frontend::InstructionInfo* findBox(std::string_view mnemonic);

// All rows, by pointers.
std::span<const network::Row* const> networkRows();
std::span<const frontend::InstructionInfo* const> instructionInfos();

} // namespace rung::gsk
