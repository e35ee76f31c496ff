// A rung as a sheet of cells, ready to be laid out: its rows are the lines of the drawing in the source, what is in
// them is in the order of the source, and all texts are what the reader is to see.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung::view {

// Where something is in the author's files: `file` is an index into Program::files, lines and columns count from 1.
// Line 0: nowhere.
struct Place {
  uint32_t file = 0;
  uint32_t line = 0;
  uint32_t column = 0;
};

// How much of what an element can do was seen in a run.
enum class Seen : uint8_t { Unasked, All, Part, Nothing };

// What a text leads to.
struct Link {
  enum class To : uint8_t { Nothing, Rung, Name };
  To to = To::Nothing;
  uint32_t id = 0; // the number of a rung, NameRow::id
};

// Rungs that have to do with something: "read in 3, 10 and 4 more".
struct CrossReference {
  std::string_view lead;
  std::vector<uint32_t> rungs; // numbers
  uint32_t further = 0;        // that are left out
  Link all;                    // where they are
};

struct Operand {
  std::string label; // what it is, by the instruction's row
  std::string name;  // as written
  std::string address;
  std::string note;
  Link link; // of the name
};

struct Cell {
  enum class Kind : uint8_t { Rail, Joint, Contact, Coil, Box };
  Kind kind = Kind::Joint;
  uint32_t column = 0; // in the source: left and right of each other
  uint32_t firstRow = 0;
  uint32_t lastRow = 0;
  bool closing = false; // nothing is on its right: it leads to the right rail
  std::string mark;     // contacts and coils: "/" negated, "P" and "N" edges, "I" immediate, "S", "R"
  Operand operand;      // contacts and coils
  std::string title;    // boxes
  std::vector<std::string> pins;
  std::vector<Operand> operands;
  Link link;              // boxes: what a call or jump leads to
  CrossReference writers; // contacts: the rungs that write them, without their own
  Place place;            // contacts, coils and boxes: of the element; in a command list of its command
  Seen seen = Seen::Unasked;
  std::string badge;  // what was not seen, in two words
  std::string detail; // of the run, in full
};

// A cell where a row meets it; a joint or a box is in all its rows.
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
