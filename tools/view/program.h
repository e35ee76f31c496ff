// A program in printable form: headings, comments and rungs in the order of the source, then its names with the rungs
// that use them. Positions on paper are computed later.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/chart/chart.h"
#include "frontend/dialects/dialect.h"
#include "frontend/ladder/text/ladder_file.h"
#include "frontend/network/convert/convert.h"
#include "tools/report/cross_reference.h"
#include "tools/view/sheet.h"

namespace rung::view {

// A source file that the reader knows.
struct SourceFile {
  std::string path; // as given to the compiler
  std::string name; // as shown: without its folder if that is unambiguous
};

std::vector<SourceFile> shownFiles(const std::vector<std::string>& paths);
// The title of a program without another one: its file, or the folder of its files. `files` is not empty.
std::string titleOf(const std::vector<SourceFile>& files);

// Results of runs for a rung.
struct Run {
  enum class State : uint8_t { Unasked, Ran, Never };
  State state = State::Unasked;
  double heat = 0; // 0 to 1
  std::string label;
  std::string detail;
};

// A unit that waits, as a chart of its parts.
struct Chart {
  frontend::chart::Sequence sequence;
  std::vector<bool> waits; // by part: a run has stopped there
};

inline constexpr uint32_t kNoChart = UINT32_MAX;

struct Figure {
  uint32_t number = 0; // from 1
  std::string title;   // the rung's comment
  std::vector<std::string> comments;
  Place place;
  std::vector<std::string> labels;
  Sheet sheet;
  uint32_t chart = kNoChart; // in Program::charts: drawn instead of the sheet
  Run run;
};

struct Block {
  enum class Kind : uint8_t { File, Module, Section, Comment, Rung, Chart };
  Kind kind = Kind::Comment;
  std::string text;    // of a Comment: its lines
  std::string comment; // the comment after the statement
  std::string title;   // of a Module: the title given by the section or comment before it
  CrossReference callers;
  Place place;
  uint32_t figure = 0; // of a Rung: index in Program::figures; of a Chart without a rung: in Program::charts
};

struct Use {
  uint32_t rung = 0; // number of the rung
  bool writes = false;
  auto operator<=>(const Use&) const = default;
};

// A row of the list of names; one without a name is a comment between declarations.
struct NameRow {
  uint32_t id = 0; // index among the rows with a name
  std::string key; // as in Named
  bool constant = false;
  bool input = false;  // the machine or the NC writes it
  bool output = false; // the machine or the NC reads it
  std::string name;
  std::string address; // for a constant its value, for a message its text
  std::string comment;
  std::vector<Use> uses; // by rung
};

struct NameTable {
  std::string title;
  bool texts = false; // rows of messages and buttons, by number, which are only read
  std::vector<NameRow> rows;
};

// Results of runs for the program as a whole.
struct RunSummary {
  std::string title; // empty: no results
  std::vector<std::string> lines;
  std::string heat; // of what Run::heat is a share
};

struct Program {
  std::string title;
  std::string control;
  std::vector<SourceFile> files;
  std::vector<Block> blocks;
  std::vector<Figure> figures;
  std::vector<Chart> charts;
  std::vector<NameTable> tables;
  RunSummary runs;
};

// Positions in the author's files of a converted program: rungs in their order, elements by their position in the
// drawing.
struct Origins {
  std::span<const SourceRange> rungs;
  std::span<const frontend::network::Origin> elements;
};

struct Input {
  const frontend::Dialect* dialect = nullptr;
  const frontend::network::Language* language = nullptr; // of a program of networks
  std::vector<FileId> files;                             // ladder text without errors
  const frontend::Analysis* analysis = nullptr;          // of `files`
  const report::CrossReference* reference = nullptr;     // of the program that `files` compile to
  std::span<const ir::MessageText> messages;             // of the same program
  Origins origins;                                       // if `files` are a conversion
  std::vector<FileId> authors;                           // the files that the author wrote
};

Program readProgram(const SourceManager& sources, const Input& input);
// A program of charts: of `input`, `dialect`, `analysis`, `reference` and `authors` are used.
Program readCharts(const SourceManager& sources, const Input& input, frontend::chart::Program charts);

// The contents of a program as a list: files, modules and sections with their rungs.

struct ContentsEntry {
  enum class Kind : uint8_t { File, Module, Section };
  Kind kind = Kind::Section;
  uint32_t block = 0;     // target: index in Program::blocks
  uint32_t level = 0;     // nesting depth, from 0
  std::string text;       // such as "spindles.lad", "Subprogram P5"
  std::string title;      // such as "overrides"; for a file, the module that it begins with
  uint32_t firstRung = 0; // 0: no rung
  uint32_t lastRung = 0;
};

std::vector<ContentsEntry> contentsOf(const Program& program);

} // namespace rung::view
