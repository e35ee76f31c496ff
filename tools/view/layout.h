// The geometry of a rung: a sheet of cells to lines, symbols and texts at places. Pure functions, linear in the cells
// (but for a sort); the writers only print what they give.
//
// Rows keep the order of the source and are as high as what is in them. Cells go from left to right as far as the
// cells on their left make room; a joint is in one place in all its rows. What closes a branch is at the right
// rail. A rung that is wider than the rails allow is cut between its cells into bands, one below the other; a wire that
// was cut ends at a number and continues after the same number.
#pragma once
#include <string>
#include <vector>

#include "tools/view/sheet.h"
#include "tools/view/style.h"

namespace rung::view {

struct Point {
  int x = 0;
  int y = 0;
};

struct Line {
  Point from;
  Point to; // right of or below `from`
};

enum class Glyph : uint8_t { Contact, Coil };

struct Symbol {
  Glyph glyph = Glyph::Contact;
  bool slash = false;
  Point left; // where its wires end
  int width = 0;
};

struct Frame {
  Point corner;
  int width = 0;
  int height = 0;
  int head = 0; // height of the bar with the mnemonic
};

// Round an element: how much of it was seen in a run.
struct Halo {
  Point corner;
  int width = 0;
  int height = 0;
  Seen seen = Seen::Unasked;
  std::string detail;
};

enum class Anchor : uint8_t { Start, Middle, End };

struct Text {
  Point at; // on the base line
  Anchor anchor = Anchor::Middle;
  Style style = Style::Name;
  std::string text;
  std::vector<LinkedText::Part> links;
};

// A wire that was cut: its end, and where it continues.
struct Jump {
  Point from;
  Point to;
};

struct Picture {
  int width = 0; // of everything
  int top = 0;   // y of its upper side: not 0 in a piece of a drawing
  int height = 0;
  std::vector<int> breaks; // heights at which only vertical wires are cut, from top to bottom
  int rail = 0;            // x of the right rail; the left one is at kLeft
  std::vector<Line> wires;
  std::vector<Jump> jumps;
  std::vector<Point> dots; // where three wires meet
  std::vector<Symbol> symbols;
  std::vector<Frame> frames;
  std::vector<Halo> halos;
  std::vector<Text> texts;
};

inline constexpr int kLeft = 8;        // x of the left rail
inline constexpr int kSymbolHalf = 11; // half the height of a contact or coil
inline constexpr int kMargin = 160;    // for remarks, right of the right rail

// The place of the right rail that the sheet needs when it is not cut.
int neededRail(const Sheet& sheet);
// `rail`: where the right rail should be; it goes further to the right where no cut helps.
Picture layOut(const Sheet& sheet, int rail);

// Where a rung that is too wide is cut. Internal to the layout.

inline constexpr int kBandStart = 64; // x of the first cell of a band after a cut
inline constexpr int kBandWire = 52;  // and of the wires that continue there
inline constexpr int kBandEnd = 40;   // from the ends of the wires to the right rail

// Places, from left to right, that no cell but a joint lies across: a band is what begins between two of them.
using Cuts = std::vector<int>;

// `left`, `width`: of the cells. `needed`: where the right rail of the whole would be, `rail`: where it is to be.
// A band may be wider where there is no place for a cut.
Cuts chooseCuts(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& width, int needed, int rail);

// A drawing that is higher than a page, cut between its rows.

// Pieces of at most `most` pixels where the rows allow it, from top to bottom, with the coordinates of the whole; the
// drawing itself when it is not higher. Every shape is in one piece; vertical wires continue from piece to piece.
std::vector<Picture> piecesOf(const Picture& picture, int most);

} // namespace rung::view
