// The condition before SP, which has no effect (P13), in ladder text: a drawing has no position for it, so it is
// written as comments directly after the line of the module:
//   module SUB P7
//   ; condition: LD X1.0
//   ; condition: OR X1.1
// These comments are a condition only if a command list would accept their commands as one; otherwise, and everywhere
// else, they are ordinary comments and may be titles.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/network/program.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::network {

inline constexpr std::string_view kConditionComment = "condition:";

// The condition of a module from the comments directly after it: one command per line, with the range of the comment.
std::vector<Written> conditionIn(const Context& context, std::span<const ladder::Comment> comments);

} // namespace rung::frontend::network
