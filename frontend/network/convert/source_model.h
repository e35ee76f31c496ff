// A program as its author wrote it: the commands with their operands as spelled, in their order, and everything that is
// not a command (comments, declarations, sections) where it was. Both source forms are read to it and written from it.
//
// Gaps. What is before a network is its gap. The title of a network is one of the comments of its gap, where
// the rule of titles (title.h) finds it. Comments have no ';' before them, no blanks at their ends, no control
// characters.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "frontend/network/program.h"

namespace rung::network::convert {

struct Item {
  enum class Kind : uint8_t { Comment, Blank, Dialect, Symbol, Const, Section };
  Kind kind = Kind::Comment;
  std::string text = {};    // of a comment, a section; the name of a symbol or constant
  std::string value = {};   // of a symbol or constant
  std::string comment = {}; // after a statement
};
using Gap = std::vector<Item>;

struct SourceCommand : Written {
  std::vector<std::string> before = {}; // comment lines before it; those of the first command are in the gap
  std::string comment = {};             // after it, on its line
};

// Whether a drawing has an element of its own for it.
constexpr bool isElement(Command command) {
  return isContact(command) || isCoil(command) || command == Command::Function;
}

// The commands of the first and the last element of a line; kNone where it has none.
struct LineEnds {
  uint32_t first = kNone;
  uint32_t last = kNone;

  // The places of two commands of the line compare as their columns do.
  template <class PlaceOf>
  void add(uint32_t command, PlaceOf placeOf) {
    if (first == kNone || placeOf(command) < placeOf(first)) first = command;
    if (last == kNone || placeOf(last) < placeOf(command)) last = command;
  }
};

struct SourceNetwork {
  Gap gap;
  std::string title;
  const Row* row = nullptr;
  SourceRange range;
  std::vector<SourceCommand> commands;
};

// A level or a subprogram; its end is not among its networks.
struct SourceUnit {
  UnitKind kind = UnitKind::Level;
  uint32_t level = 0;                   // its place in Language::levels
  std::string_view number;              // of a subprogram: "P5", as spelled
  Gap lead;                             // before `module`; in a list of the end of the level before it, or of SP
  std::string comment;                  // after it, on its line
  std::vector<SourceCommand> condition; // of SP, without effect (P13)
  std::vector<SourceNetwork> networks;
};

struct SourceProgram {
  Gap preamble;                  // up to the last declaration before all networks; with the one Dialect
  std::vector<SourceUnit> units; // levels, then subprograms
  Gap tail;
};

// The logic commands as the stack register sees them.
std::vector<Logic> logicOf(const std::vector<SourceCommand>& commands);

// Control characters become blanks, blanks at the ends go.
std::string clean(std::string_view text);

} // namespace rung::network::convert
