// State that the compiler made for instructions, slots and hidden names, in two versions of a program: which continues
// as which.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/change/rung_alignment.h"

namespace rung::runtime {

struct InstructionState {
  std::string_view key;      // as rung_slot has it
  uint32_t rung = RUNG_NONE; // that uses it, in rung_program::rungs; RUNG_NONE: none does
};

// By those of the new version: the number of the former one, or RUNG_NONE: it starts anew. An instruction's state goes
// where its rung has gone. What has no rung, or whose rung is new, goes by its key, where as many are left on both
// sides.
std::vector<uint32_t> matchState(std::span<const InstructionState> before, std::span<const InstructionState> after,
                                 std::span<const RungPair> rungs);

// A key without the numbers of instructions that are alike.
std::string withoutNumbers(std::string_view key);

} // namespace rung::runtime
