// The geometry of a rung: from a sheet of cells to lines, symbols and texts at positions. Pure functions, linear in the
// number of cells (except for a sort); the writers only print their results.
//
// Rows keep the order of the source and are as high as their contents. Cells are placed from left to right as close as
// the cells on their left allow; a joint has the same x in all its rows. The cell that ends a branch is at the right
// rail. A rung that is wider than the rails allow is cut between its cells into bands, one below the other; a cut wire
// ends at a number and continues after the same number.
#pragma once
#include <string>
#include <vector>

#include "tools/view/program.h"
#include "tools/view/sheet.h"
#include "tools/view/style.h"

namespace rung::view {

struct Point {
  int x = 0;
  int y = 0;
};

struct Line {
  Point from;
  Point to;          // right of or below `from`
  uint32_t cell = 0; // what gives it power: the cell at its left end, or the joint that it is
};

enum class Glyph : uint8_t { Contact, Coil };

struct Symbol {
  Glyph glyph = Glyph::Contact;
  bool slash = false;
  Point left; // left end, where its wire ends
  int width = 0;
  uint32_t cell = 0; // index in Sheet::cells
};

struct Frame {
  Point corner;
  int width = 0;
  int height = 0;
  int head = 0;      // height of the bar with the mnemonic
  uint32_t cell = 0; // index in Sheet::cells
};

// The space for the value of a box's operand, which only a running program has.
struct ValueSpace {
  Point at; // left end, on the baseline
  uint32_t cell = 0;
  uint32_t operand = 0; // index in Cell::operands
};

// A mark around an element: how much of it was seen in a run.
struct Halo {
  Point corner;
  int width = 0;
  int height = 0;
  Seen seen = Seen::Unasked;
  std::string detail;
};

// A part of a chart in which a unit may wait.
struct Step {
  Point corner;
  int width = 0;
  int height = 0;
  std::string continuation;     // key of the cell that says where the unit continues
  std::vector<uint32_t> states; // its values here
  bool waits = false;
};

enum class Anchor : uint8_t { Start, Middle, End };

struct Text {
  Point at; // on the baseline
  Anchor anchor = Anchor::Middle;
  Style style = Style::Name;
  std::string text;
  std::vector<LinkedText::Part> links;
};

// The two ends of a cut wire: where it stops, and where it continues.
struct Jump {
  Point from;
  Point to;
};

struct Picture {
  int width = 0; // width of the whole drawing
  int top = 0;   // y of its upper edge: not 0 in a part of a drawing
  int height = 0;
  std::vector<int> breaks; // heights at which a cut crosses only vertical wires, from top to bottom
  int rail = 0;            // x of the right rail; x of the left one is kLeft; 0: there are no rails
  std::vector<Line> wires;
  std::vector<Jump> jumps;
  std::vector<Point> dots; // where three wires meet
  std::vector<Symbol> symbols;
  std::vector<Frame> frames;
  std::vector<Halo> halos;
  std::vector<Step> steps;
  std::vector<Line> bars;    // across a line of control: what is waited for
  std::vector<Point> arrows; // their points, to the right
  std::vector<Text> texts;
  std::vector<ValueSpace> values; // none without space for them
};

inline constexpr int kLeft = 8;        // x of the left rail
inline constexpr int kSymbolHalf = 11; // half the height of a contact or coil
inline constexpr int kMargin = 160;    // space for remarks to the right of the right rail

// Functions with `valueSpace` leave so many pixels for the value of each operand of a box that is a place.

// The x that the right rail needs if the sheet is not cut.
int neededRail(const Sheet& sheet, int valueSpace = 0);
// `rail`: desired x of the right rail; it is further to the right if no cut helps.
Picture layOut(const Sheet& sheet, int rail, int valueSpace = 0);
Picture layOut(const Chart& chart);

// Chooses where to cut a rung that is too wide. Internal to the layout.

inline constexpr int kBandStart = 64; // x of the first cell of a band after a cut
inline constexpr int kBandWire = 52;  // x of the wires that continue there
inline constexpr int kBandEnd = 40;   // from the ends of the wires to the right rail

// Cut positions, from left to right, that no cell but a joint crosses: a band is what begins between two of them.
using Cuts = std::vector<int>;

// `left`, `width`: of the cells. `needed`: x of the right rail without cuts, `rail`: desired x. A band may be wider if
// there is no position for a cut.
Cuts chooseCuts(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& width, int needed, int rail);

// Cuts a drawing that is higher than a page between its rows.

// Parts of at most `most` pixels in height if the rows allow it, from top to bottom, in the coordinates of the whole;
// the drawing itself if it is not higher. Every shape is in one part; vertical wires continue from part to part.
std::vector<Picture> piecesOf(const Picture& picture, int most);

} // namespace rung::view
