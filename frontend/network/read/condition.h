// The condition before SP, which has no effect (P13), in ladder text: a drawing has no place for it, so it is comments
// directly after the line of the module:
//   module SUB P7
//   ; condition: LD X1.0
//   ; condition: OR X1.1
// They are one where a command list would take their commands for a condition; else, and everywhere else, such comments
// are comments like any other, and may be titles.
#pragma once
#include <string_view>
#include <vector>

#include "frontend/network/program.h"
#include "frontend/network/read/context.h"

namespace rung::network {

inline constexpr std::string_view kConditionComment = "condition:";

struct Condition {
  std::vector<Written> commands; // one a line; the ranges are those of the comments
  uint32_t lastLine = 0;         // of the condition, or of the module where there is none
};

// What is said of the module whose line that is.
Condition conditionAfter(const Context& context, FileId file, uint32_t moduleLine);

} // namespace rung::network
