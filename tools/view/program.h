// A program as it is printed: headings, comments and rungs in the order of the source, then its names with the rungs
// that use them. What writers print; nothing here has a place on paper yet.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "frontend/ladder/text/ladder_file.h"
#include "frontend/network/convert/convert.h"
#include "tools/report/cross_reference.h"
#include "tools/view/sheet.h"

namespace rung::view {

// One of the files that the reader knows.
struct SourceFile {
  std::string path; // as it was given to the compiler
  std::string name; // as it is shown: without its folder where that is enough
};

std::vector<SourceFile> shownFiles(const std::vector<std::string>& paths);
// Of a program that has no other title: its file, or the folder of its files. There is one file at least.
std::string titleOf(const std::vector<SourceFile>& files);

// What is known of a rung from runs of the program.
struct Run {
  enum class State : uint8_t { Unasked, Ran, Never };
  State state = State::Unasked;
  double heat = 0; // a share, 0 to 1
  std::string label;
  std::string detail;
};

struct Figure {
  uint32_t number = 0; // from 1
  std::string title;   // the rung's comment
  std::vector<std::string> comments;
  Place place;
  Sheet sheet;
  Run run;
};

struct Block {
  enum class Kind : uint8_t { File, Module, Section, Comment, Rung };
  Kind kind = Kind::Comment;
  std::string text;    // Comment: its lines
  std::string comment; // after the statement
  std::string title;   // Module: what the section or comment before it says it is
  CrossReference callers;
  Place place;
  uint32_t figure = 0; // Rung: index into Program::figures
};

struct Use {
  uint32_t rung = 0; // its number
  bool writes = false;
  auto operator<=>(const Use&) const = default;
};

// A row of the list of names; one without a name is a comment between declarations.
struct NameRow {
  uint32_t id = 0; // its place among all rows with a name
  std::string key; // as in Named
  bool constant = false;
  bool input = false;  // the machine or the NC writes it
  bool output = false; // the machine or the NC reads it
  std::string name;
  std::string address; // a constant's value, a message's text
  std::string comment;
  std::vector<Use> uses; // by rung
};

struct NameTable {
  std::string title;
  bool texts = false; // of messages and buttons, by number: they are only read
  std::vector<NameRow> rows;
};

// What runs of the program say of it as a whole.
struct RunSummary {
  std::string title; // empty: there were none
  std::vector<std::string> lines;
  std::string heat; // what Run::heat is a share of
};

struct Program {
  std::string title;
  std::string control;
  std::vector<SourceFile> files;
  std::vector<Block> blocks;
  std::vector<Figure> figures;
  std::vector<NameTable> tables;
  RunSummary runs;
};

// Where the author wrote what a converted file has: its rungs in their order, its elements by where they are drawn.
struct Origins {
  std::span<const SourceRange> rungs;
  std::span<const frontend::network::Origin> elements;
};

struct Input {
  const frontend::Dialect* dialect = nullptr;
  std::vector<FileId> files;                         // ladder text without errors
  const frontend::Analysis* analysis = nullptr;      // of `files`
  const report::CrossReference* reference = nullptr; // of what they compile to
  std::span<const ir::MessageText> messages;         // of the same
  Origins origins;                                   // where `files` is a conversion
  std::vector<FileId> authors;                       // the files that the reader knows
};

Program readProgram(const SourceManager& sources, const Input& input);

// What a program consists of, as a list: files, modules and sections with the rungs in them.

struct ContentsEntry {
  enum class Kind : uint8_t { File, Module, Section };
  Kind kind = Kind::Section;
  uint32_t block = 0;     // index into Program::blocks: where it leads
  uint32_t level = 0;     // from 0: how deep it is
  std::string text;       // "spindles.lad", "Subprogram P5"
  std::string title;      // "overrides"; of a file the module that it begins with
  uint32_t firstRung = 0; // 0: there is none
  uint32_t lastRung = 0;
};

std::vector<ContentsEntry> contentsOf(const Program& program);

} // namespace rung::view
