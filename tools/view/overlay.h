// Results of runs for a program's drawing: the share of time of each rung (a profile), what was seen of each element
// (coverage).
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/view/program.h"

namespace rung::view {

// A position as the compiler knows it.
struct SourcePlace {
  std::string file; // as given to the compiler
  uint32_t line = 0;
  uint32_t column = 0;
};

struct RungOverlay {
  uint32_t number = 0; // as drawn; 0: the rung is the one that begins at `place`
  SourcePlace place;   // the column is ignored
  Run run;
};

struct ElementOverlay {
  enum class Kind : uint8_t { Contact, Coil, Box };
  Kind kind = Kind::Contact;
  // The bracket that begins the element; in a command list, the command. Without a column: the only element that begins
  // on the line.
  SourcePlace place;
  bool off = false;    // seen: a contact without power, a coil that is off, a box without power
  bool on = false;     // seen: a contact that conducts, a coil that is on, a box with power
  bool decided = true; // contacts: it alone decided the outcome of its rung, or this was not examined
  std::string detail;  // text shown at the element
};

// Where a unit waits: the cell that the program's table of continuations names, and its value.
struct StepOverlay {
  std::string continuation; // its key
  uint32_t state = 0;
};

struct Overlay {
  std::string title;                // such as "Profile"
  std::vector<std::string> summary; // lines of text
  std::string heat;                 // what the rungs' colours mean: "share of all operations"; empty without colours
  std::vector<RungOverlay> rungs;
  std::vector<ElementOverlay> elements;
  std::vector<StepOverlay> steps;
};

// Such as "never closed"; "" if everything was seen.
std::string badgeOf(const ElementOverlay& element);
Seen seenOf(const ElementOverlay& element);

// The colour of a rung, 0 for none, up to kHeatSteps; `hottest` is the largest heat of the program's rungs.
inline constexpr int kHeatSteps = 5;
int heatStep(const Run& run, double hottest);
// The text at a rung: its label, or "ran", "never ran"; "" if this was not examined.
std::string_view labelOf(const Run& run);

// Adds the results of runs to the program. Entries for places that it does not have are ignored.
void lay(const Overlay& overlay, Program& program);

} // namespace rung::view
