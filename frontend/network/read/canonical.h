// Trees of contacts to the commands of a list and back (§5). One tree has one canonical list; a list may say the same
// with other blocks.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/network/program.h"
#include "frontend/network/read/series_parallel.h"

namespace rung::frontend::network {

struct CanonicalStep {
  Logic kind = Logic::Load;
  ladder::ElementId contact; // invalid: a block command
};

// The first branch of a parallel group begins with LD, a further branch of one contact is OR, any other one a block of
// its own and ORB; a parallel group in series after something is a block of its own and ANB.
std::vector<CanonicalStep> canonicalSteps(const SpTree& tree);

// The values on the stack after the commands, that of the first LD first. Contacts are numbered in the order of
// the commands. Nullopt where a command lacks a value.
std::optional<std::vector<SpTree>> treesOf(std::span<const Logic> commands);

// `list: LD LD ORB`, a comment at the top of a drawing: its logic commands where they are not the canonical ones. Both
// say the same, but the commands are what steps are counted by and what the memory of a network is known by.
std::string blocksHint(const Language& language, std::span<const Logic> commands);
std::optional<std::vector<Logic>> parseBlocksHint(const Language& language, std::string_view comment);

// The steps of a drawing as the hint has them; nothing where the hint does not say the same, or needs more than
// `stackDepth` values.
std::optional<std::vector<CanonicalStep>> withBlocks(const std::vector<CanonicalStep>& steps,
                                                     std::span<const Logic> blocks, uint32_t stackDepth);

// The words of a comment.
std::vector<std::string_view> wordsIn(std::string_view comment);

} // namespace rung::frontend::network
