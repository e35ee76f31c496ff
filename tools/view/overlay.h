// What runs of a program say of it, laid over its drawing: which rungs take the time (a profile), what was seen of each
// element (coverage).
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/view/program.h"

namespace rung::view {

// A place as the compiler knows it.
struct SourcePlace {
  std::string file; // as it was given to the compiler
  uint32_t line = 0;
  uint32_t column = 0;
};

struct RungOverlay {
  uint32_t number = 0; // as drawn; 0: the rung that begins at `place`
  SourcePlace place;   // the column says nothing
  Run run;
};

struct ElementOverlay {
  enum class Kind : uint8_t { Contact, Coil, Box };
  Kind kind = Kind::Contact;
  // Of the bracket that the element begins with; in a command list of its command. Without a column: the only element
  // that begins on the line.
  SourcePlace place;
  bool off = false;    // seen: a contact that passes no power, a coil that is off, a box without power
  bool on = false;     // seen: a contact that passes power, a coil that is on, a box with power
  bool decided = true; // contacts: one alone decided what its rung does, or this was not asked for
  std::string detail;  // to be read at the element
};

struct Overlay {
  std::string title;                // "Profile"
  std::vector<std::string> summary; // lines
  std::string heat;                 // what the colours of rungs mean: "share of all operations"; empty without colours
  std::vector<RungOverlay> rungs;
  std::vector<ElementOverlay> elements;
};

// "never closed"; nothing where all was seen.
std::string badgeOf(const ElementOverlay& element);
Seen seenOf(const ElementOverlay& element);

// Which of the colours a rung has, 0 for none, up to kHeatSteps; `hottest` is the most that a rung of its program has.
inline constexpr int kHeatSteps = 5;
int heatStep(const Run& run, double hottest);
// What is written at a rung: its label, or "ran", "never ran"; nothing if it was not asked for.
std::string_view labelOf(const Run& run);

// Fills what the drawing says of runs. Places that it does not have are passed over.
void lay(const Overlay& overlay, Program& program);

} // namespace rung::view
