// A program as the page shows it: rows from top to bottom, of known heights, so that only those are drawn that are
// looked at; and the elements whose power the page shows. Immutable once made: any thread.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tools/view/layout.h"
#include "tools/view/program.h"

namespace rung::web {

// What is known of an element (a contact, a coil, a box, a step of a chart) after a scan. A set of bits.
enum ElementState : uint8_t {
  kEvaluated = 1, // in this scan
  kOn = 2,        // a contact conducts, a coil or a box has power, a unit continues at this step
  kResultKnown = 4,
  kResult = 8,    // a box has power at its output, or conducts
  kConducts = 16, // the result of a box, such as a comparison, is like that of a contact
  kConstant = 32, // a contact whose bit never changes
  kWired = 64,    // the program says nothing of it: a coil or a box has the power of its wire
};

// Drawings are cut to the width of a page; then they are higher.
enum class Width : uint8_t { Wide, Tablet, Phone };
inline constexpr size_t kWidths = 3;

// What the page shows as a row.
struct Row {
  enum class Kind : uint8_t { File, Module, Section, Comment, Rung, Chart };
  Kind kind = Kind::Comment;
  std::array<int, kWidths> heights{}; // pixels, by Width
  uint32_t number = 0;                // of a rung, as drawn
  uint32_t index = 0;                 // of a rung: in the figures of the drawing; of a chart: in its charts
  uint32_t firstElement = 0;
  uint32_t elements = 0;
};

class ShownProgram {
public:
  explicit ShownProgram(view::Program program);

  const std::string& title() const { return drawing_.title; }
  const std::string& control() const { return drawing_.control; }
  std::span<const Row> rows() const { return rows_; }
  std::vector<view::ContentsEntry> contents() const;
  const view::Program& drawing() const { return drawing_; }
  const std::vector<view::NameTable>& tables() const { return drawing_.tables; }
  uint32_t elementCount() const { return elements_; }
  // Pixels of the row.
  int heightOf(uint32_t row, Width width) const { return rows_[row].heights[static_cast<size_t>(width)]; }

  // The elements of a row at a position of its file: an instruction may be drawn as several. Column 0: the only one
  // that begins on the line.
  std::vector<uint32_t> elementsAt(uint32_t row, uint32_t line, uint32_t column) const;
  // The cell of an element of a row that has a sheet.
  const view::Cell& cellOf(uint32_t row, uint32_t element) const;
  // The left rail of a rung and its coils and boxes, all of them elements. Nothing for a row without a sheet.
  std::optional<uint32_t> railOf(uint32_t row) const;
  std::vector<uint32_t> poweredOf(uint32_t row) const;
  // The row of a rung by its number.
  std::optional<uint32_t> rowOf(uint32_t rung) const;
  // "Rung 3: start/stop latch"; "" for other rows.
  std::string nameOf(uint32_t row) const;

  // The title of a rung, the text of a heading or comment.
  const std::string& titleOf(uint32_t row) const;

  // The row as HTML.
  std::string html(uint32_t row, Width width) const;
  // The power in a rung, a character for each of its elements: '-' not evaluated in this scan, otherwise '0' plus 1 if
  // it is on, 2 if there is power after it. "" for a row without elements, or if the rung did not run. `states`: of
  // all elements.
  std::string flow(uint32_t row, std::span<const uint8_t> states) const;

  // The contacts of the drawing.
  struct Contact {
    uint32_t element = 0;
    std::string_view name; // as written
    bool negated = false;
  };
  std::vector<Contact> contacts() const;

  // How names are drawn as contacts and coils, by NameRow::id: "| |", "|/|", "( )", "(S)" ...
  std::map<uint32_t, std::set<std::string>> shapes() const;

  // The steps of charts at which units may continue.
  struct Step {
    uint32_t element = 0;
    std::string_view continuation; // key of the ir::Continuation
    std::vector<uint32_t> states;  // its values that mean this step
  };
  std::vector<Step> steps() const;

  // A place whose value the row shows, as written, and where.
  struct ShownValue {
    std::string name;
    uint32_t element = 0; // of the row
    uint32_t operand = 0;
  };
  std::vector<ShownValue> values(uint32_t row) const;

private:
  using Key = std::tuple<uint32_t, uint32_t, uint32_t>; // row, line, column
  // How power goes through a sheet: for each cell those that it comes from, by row, and those that it leads to.
  struct Path {
    std::vector<std::vector<uint32_t>> from;
    std::vector<std::vector<uint32_t>> to;
  };
  class Power;
  void addFigure(uint32_t index);
  void addChart(uint32_t index);
  void addRow(Row row);
  const view::Chart* chartOf(const Row& row) const; // null: the row has no chart
  view::Picture pictureOf(const view::Figure& figure, Width width) const;
  std::string rungHtml(uint32_t row, Width width) const;
  std::string drawingHtml(const Row& row, Width width) const;
  static Path pathOf(const view::Sheet& sheet);

  view::Program drawing_;
  std::vector<Path> paths_; // by figure
  std::vector<Row> rows_;
  std::map<uint32_t, uint32_t> rowsByRung_;
  std::multimap<Key, uint32_t> byPlace_;
  uint32_t elements_ = 0;
  int rail_ = 0;
};

} // namespace rung::web
