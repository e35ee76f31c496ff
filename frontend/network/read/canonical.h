// Converts trees of contacts to the commands of a list and back (§5). A tree has one canonical list; other lists may
// express it with other blocks.
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

// The first branch of a parallel group begins with LD; a further branch of one contact is OR, any other one a separate
// block with ORB; a parallel group in series after something is a separate block with ANB.
std::vector<CanonicalStep> canonicalSteps(const SpTree& tree);

// The values on the stack after the commands, the first LD's first. Contacts are numbered in the order of the commands.
// Nullopt if a command lacks a value.
std::optional<std::vector<SpTree>> treesOf(std::span<const Logic> commands);

// `list: LD LD ORB`, a comment at the top of a drawing: its logic commands if they are not the canonical ones. Both
// have the same meaning, but steps are counted by the commands and the memory of a network is identified by them.
std::string blocksHint(const Language& language, std::span<const Logic> commands);
std::optional<std::vector<Logic>> parseBlocksHint(const Language& language, std::string_view comment);

// The steps of a drawing according to the hint; nothing if the hint has another meaning, or needs more than
// `stackDepth` values.
std::optional<std::vector<CanonicalStep>> withBlocks(const std::vector<CanonicalStep>& steps,
                                                     std::span<const Logic> blocks, uint32_t stackDepth);

// The words of a comment.
std::vector<std::string_view> wordsIn(std::string_view comment);

} // namespace rung::frontend::network
