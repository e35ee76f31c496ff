// Trees of contacts to the commands of a list and back (§5). One tree has one canonical list; a list may say the same
// with other blocks.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "frontend/dialects/gsk/program.h"
#include "frontend/dialects/gsk/series_parallel.h"

namespace rung::gsk {

struct CanonicalStep {
  Logic kind = Logic::Load;
  ladder::ElementId contact; // invalid: a block command
};

// The first branch of a parallel group begins with LD, a further branch of one contact is OR, any other one a block of
// its own and ORB; a parallel group in series behind something is a block of its own and ANB.
std::vector<CanonicalStep> canonicalSteps(const SpTree& tree);

// The values on the stack behind the commands, the one of the first LD in front. Contacts are numbered in the order of
// the commands. Nullopt where a command lacks a value.
std::optional<std::vector<SpTree>> treesOf(std::span<const Logic> commands);

} // namespace rung::gsk
