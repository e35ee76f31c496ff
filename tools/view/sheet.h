// A rung as a sheet of cells, ready to be laid out: its rows are the lines of the drawing in the source, their contents
// are in source order, and all texts are final.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung::view {

// A position in the author's files: `file` is an index in Program::files, lines and columns count from 1. Line 0: none.
struct Place {
  uint32_t file = 0;
  uint32_t line = 0;
  uint32_t column = 0;
};

// How much of an element's behaviour was seen in a run.
enum class Seen : uint8_t { Unasked, All, Part, Nothing };

// The target of a text.
struct Link {
  enum class To : uint8_t { Nothing, Rung, Name };
  To to = To::Nothing;
  uint32_t id = 0; // number of the rung, or NameRow::id
};

// References to rungs: "read in 3, 10 and 4 more".
struct CrossReference {
  std::string_view lead;
  std::vector<uint32_t> rungs; // numbers of rungs
  uint32_t further = 0;        // number of rungs that are left out
  Link all;                    // where all are listed
};

struct Operand {
  std::string label; // its meaning, by the row of the instruction
  std::string name;  // as written
  std::string address;
  std::string note;
  Link link; // of the name
};

struct Cell {
  enum class Kind : uint8_t { Rail, Joint, Contact, Coil, Box };
  Kind kind = Kind::Joint;
  uint32_t column = 0; // in the source; gives the order from left to right
  uint32_t firstRow = 0;
  uint32_t lastRow = 0;
  bool closing = false; // nothing is to its right: it leads to the right rail
  std::string mark;     // contacts and coils: "/" negated, "P" and "N" edges, "I" immediate, "S", "R"
  Operand operand;      // contacts and coils
  std::string title;    // boxes
  std::vector<std::string> pins;
  std::vector<Operand> operands;
  Link link;              // boxes: target of a call or jump
  CrossReference writers; // contacts: the rungs that write them, except their own
  Place place;            // contacts, coils and boxes: position of the element; in a command list, of its command
  Seen seen = Seen::Unasked;
  std::string badge;  // what was not seen, in two words
  std::string detail; // results of the run, in full
};

// The crossing of a cell and a row; a joint or a box is in several rows.
struct Stop {
  uint32_t cell = 0;
  bool joined = false; // by a wire to the stop on its left
};

struct Row {
  std::vector<Stop> stops;
  std::string remark;
  std::vector<CrossReference> uses;
};

struct Sheet {
  std::vector<Cell> cells; // the first is the left rail
  std::vector<Row> rows;
};

} // namespace rung::view
