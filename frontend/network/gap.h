// What is not a command in a program, as its author wrote it. Readers of both forms keep it with the network or unit
// that it is before, where a conversion asks for it.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace rung::frontend::network {

// Comments have no ';' before them, no blanks at their ends, no control characters. The title of a network is one of
// the comments of its gap, where the rule of titles (read/title.h) finds it.
struct Item {
  enum class Kind : uint8_t { Comment, Blank, Dialect, Symbol, Const, Section };
  Kind kind = Kind::Comment;
  std::string text = {};    // of a comment, a section; the name of a symbol or constant
  std::string value = {};   // of a symbol or constant
  std::string comment = {}; // after a statement
};
using Gap = std::vector<Item>;

} // namespace rung::frontend::network
