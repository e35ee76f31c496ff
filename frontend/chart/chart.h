// A program as drawings: what a dialect without ladder text gives to tools that draw it. A rung is a number of networks
// of contacts, boxes and coils; a unit that waits is also a sequence of parts. Plain data in the order of the source;
// where it is on paper is computed by tools/view.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "frontend/sema/analysis.h"
#include "ir/support/source.h"

namespace rung::frontend::chart {

inline constexpr uint32_t kNone = UINT32_MAX;

struct Operand {
  std::string label; // its meaning; in a box of several instructions the instruction, if it is the first operand of one
  std::string text;  // as written; that of a negated contact without the sign
  OperandUse use;    // no bits: it names no place
  uint32_t name = kNoDefinition; // in Analysis::definitions, of an operand that names no place
  TargetUse target;              // without a scope: not a place in the program
};

enum class NodeKind : uint8_t {
  Contact,
  Coil,
  Box,
  Series,   // `parts` from left to right
  Parallel, // `parts` from top to bottom, joined at both ends
  Outputs,  // `parts` from top to bottom, each leads to the right rail
};

// A part of a rung.
struct Node {
  NodeKind kind = NodeKind::Series;
  std::string mark;  // of a contact: "/" negated, "P", "N" edges, NOT; of a coil: "S", "R", or its instruction
  std::string title; // of a box
  std::string text;  // of a box: its instructions as written
  std::vector<Operand> operands; // of a contact or coil at most one
  std::vector<uint32_t> parts;   // of a box: what leads to its second pin, third pin ...
  std::string comment;           // after the lines of its instructions
  uint32_t statement = kNone;    // number of its instruction in the program
  uint32_t line = 0;             // position of the instruction in the rung's file
  uint32_t column = 0;
};

struct Rung {
  uint32_t number = 0; // as in ir::Rung
  std::string title;
  FileId file;
  uint32_t line = 0;
  std::vector<std::string> labels;
  std::vector<TargetUse> targets;    // the same labels
  std::vector<std::string> comments; // that are alone on a line, and uses of macros
  std::vector<Node> nodes;
  std::vector<uint32_t> networks; // their roots, from top to bottom
};

// A unit that waits.

struct Line {
  uint32_t rung = 0; // number of the rung
  std::string text;
  uint32_t target = kNone; // the part to which control may go
};

// Code that control enters at its beginning only.
struct Part {
  std::vector<uint32_t> states; // values of the continuation that mean that the unit continues here
  uint32_t first = 0;           // number of the rung that begins it
  std::string label;
  std::string title;
  std::vector<Line> lines;
  uint32_t rung = 0;       // number of the rung that waits
  std::string until;       // what ends the wait; empty: nothing is waited for here
  std::string remark;      // the comment after the instruction that waits
  std::string otherwise;   // what leads to `target` instead
  uint32_t target = kNone; // of a wait with a limit: the part that follows it
  bool falls = true;       // the next part may follow
  bool end = false;        // the end of the unit
};

struct Sequence {
  std::string name;         // of a mechanism also that of the bit that is 1 while it is active
  uint32_t rung = 0;        // number of the rung that begins it; 0: it is a module
  std::string continuation; // key of the ir::Continuation that holds its state
  std::vector<Part> parts;  // in the order of the source
};

enum class ItemKind : uint8_t {
  File,
  Module,
  Section,     // a unit in a module, or a comment that is a heading
  Comment,     // `text`: its lines
  Declaration, // `index`: of the definition
  Rung,        // `index`: in Program::rungs
  Sequence,    // `index`: in Program::sequences; of a module, which has no rung for it
};

struct Item {
  ItemKind kind = ItemKind::Comment;
  std::string text;
  std::string comment; // after the statement
  FileId file;
  uint32_t line = 0;
  uint32_t index = 0;
  TargetUse target; // of a procedure
};

struct Program {
  std::vector<FileId> files; // of the program in their order, decoded
  std::vector<Item> items;
  std::vector<Rung> rungs; // by number: rungs[i].number == i + 1
  std::vector<Sequence> sequences;
};

} // namespace rung::frontend::chart
