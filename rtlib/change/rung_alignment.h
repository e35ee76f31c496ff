// Aligns the rungs of two versions of a program: finds the rung of one version that corresponds to a rung of the other.
// Everything that follows a rung from version to version (its state, its counts, its place in a report) uses this
// alignment.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rung/program.h"

namespace rung::runtime {

// The properties that identify a rung. The texts outlive everything made from them.
struct RungMark {
  std::string_view routine;
  uint64_t what = 0; // a hash of its contents: equal for equal rungs
  std::string_view title;
  uint32_t number = 0; // as drawn, from 1; 0: not drawn. A drawn rung may have several pieces
};

enum class RungKind : uint8_t {
  Same,
  Moved,   // the same rung, between other rungs or in another routine
  Changed, // another rung with the same title, or in the same place
};

struct RungPair {
  uint32_t before = 0; // index in the former version
  uint32_t after = 0;
  RungKind kind = RungKind::Same;
};

// Aligns two lists of rungs, in which the rungs of a routine are adjacent and in order. The pairs are ascending by
// `after`; a rung in no pair was removed or is new. Takes time in proportion to n log n.
//
// In a routine, the common beginning and end of both versions are the same rungs; then those that occur once on each
// side and keep their order (patience sorting); then the rungs between these, likewise. A remaining rung that is found
// elsewhere has moved. Of the rungs left between two that are the same, two with one title are one rung that has
// changed; those without titles are paired in order if there are equally many on both sides. Finally, two rungs with
// one title anywhere are one rung that has changed.
std::vector<RungPair> alignRungs(std::span<const RungMark> before, std::span<const RungMark> after);

// The marks of the rungs in a program's table.
std::vector<RungMark> rungMarks(const rung_program& program);

// A rung, as drawn, that differs between the two versions.
struct RungChange {
  RungKind kind = RungKind::Changed; // of a rung that both have
  uint32_t before = RUNG_NONE;       // index in the former version; RUNG_NONE: it is new
  uint32_t after = RUNG_NONE;        // index in the new version; RUNG_NONE: it was removed
};

uint32_t changeKind(const RungChange& change); // enum rung_rung_change_kind

// The changed rungs in the order of the new version, then the removed ones. `pairs`: from alignRungs.
std::vector<RungChange> changedRungs(std::span<const RungMark> before, std::span<const RungMark> after,
                                     std::span<const RungPair> pairs);

// Pairs of equal items, ascending on both sides.
std::vector<std::pair<uint32_t, uint32_t>> align(std::span<const uint64_t> before, std::span<const uint64_t> after);

// State that the compiler made for an instruction (a slot or a hidden name); matchState pairs it between two versions
// of a program.

struct InstructionState {
  std::string_view key;      // as in rung_slot
  uint32_t rung = RUNG_NONE; // index in rung_program::rungs of the rung that uses it; RUNG_NONE: no rung does
};

// For each state of the new version, the index of the state that it continues; RUNG_NONE: it starts anew. The state of
// an instruction follows its rung. State without a rung, or of a new rung, is found by its key, if equally many are
// left on both sides.
std::vector<uint32_t> matchState(std::span<const InstructionState> before, std::span<const InstructionState> after,
                                 std::span<const RungPair> rungs);

// A key without the numbers that distinguish equal instructions.
std::string withoutNumbers(std::string_view key);

} // namespace rung::runtime
