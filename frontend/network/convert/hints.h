// Comments of a drawing that say where in a command list something belongs (docs/dialects/gsk.md):
//   ; [A] text               after the command of contact [A]; its second one is [A]#2
//   ; -> {TMRB preset} text  a comment line before the parameter `preset`
// Beside these, canonical.h has the hint of other blocks, and condition.h the condition of a subprogram. A comment that
// only looks like one, naming nothing that is there, is a comment like any other.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/network/convert/source_model.h"

namespace rung::network::convert {

// The element of a drawing, "[/A]", "(S B)"; functions are "{TMRB}".
std::string elementText(Command command, std::string_view operand);

// A tag for every command of a network, no two the same; blocks are "[ORB]".
std::vector<std::string> tagsOf(const Language& language, const SourceNetwork& network);

struct Tagged {
  bool before = false;
  std::string_view tag;
  std::string_view text;
};
std::optional<Tagged> parseTag(std::string_view comment);
std::string tagged(bool before, std::string_view tag, std::string_view text);

} // namespace rung::network::convert
