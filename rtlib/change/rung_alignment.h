// The rungs of two versions of a program side by side: which is which. What has to follow a rung from one version to
// the other, its state, its counts, its place in a report, goes by this.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rung/program.h"

namespace rung::runtime {

// What distinguishes a rung from others. Texts outlive what is made from it.
struct RungMark {
  std::string_view routine;
  uint64_t what = 0; // equal: the same rung
  std::string_view title;
};

enum class RungKind : uint8_t {
  Same,
  Moved,   // the same, among others or in another routine
  Changed, // another one with its title, or in its place
};

struct RungPair {
  uint32_t before = 0; // among those of the former version
  uint32_t after = 0;
  RungKind kind = RungKind::Same;
};

// Ascending by `after`; what is in no pair was removed or is new. Rungs of a routine are together, in their order.
// Takes n log n.
//
// In a routine, what begins and ends both versions is the same, then what is once on each side and keeps its order
// (patience sorting), and so on between these. What is left and is the same elsewhere has moved. Of the rungs left
// between two that are the same, those of one title are one rung that has changed; those without titles go together in
// their order, where there are as many on both sides. In the end, what has one title anywhere is one rung that has
// changed.
std::vector<RungPair> alignRungs(std::span<const RungMark> before, std::span<const RungMark> after);

// Those of a program's table.
std::vector<RungMark> rungMarks(const rung_program& program);

// Pairs of equal items, ascending on both sides.
std::vector<std::pair<uint32_t, uint32_t>> align(std::span<const uint64_t> before, std::span<const uint64_t> after);

// State that the compiler made for instructions, slots and hidden names, in two versions of a program: which continues
// as which.

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
