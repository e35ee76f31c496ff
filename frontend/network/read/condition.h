// The condition before SP, which has no effect (P13), in ladder text: a drawing has no place for it, so it is comments
// directly after the line of the module:
//   module SUB P7
//   ; condition: LD X1.0
//   ; condition: OR X1.1
// They are one where a command list would take their commands for a condition; else, and everywhere else, such comments
// are comments like any other, and may be titles.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/network/program.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::network {

inline constexpr std::string_view kConditionComment = "condition:";

// That of a module in the comments directly after it: one command a line, with the range of the comment.
std::vector<Written> conditionIn(const Context& context, std::span<const ladder::Comment> comments);

} // namespace rung::frontend::network
