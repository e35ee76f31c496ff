// The elements of a program that conduct or get power: the contacts, coils and boxes of a drawing, the commands of a
// list, the instructions of an equation. Each is at a place of the sources; a rung of the source, and with it its
// elements, may have been lowered to several rungs of the module, and its elements belong to all of them.
//
// Everything is numbered, so that a drawing looks its cells up once.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ir/core/marks.h"
#include "ir/core/module.h"
#include "tools/report/guards.h"

namespace rung::replay {

inline constexpr uint32_t kNone = UINT32_MAX;

// A place of an element where power is known: a contact has one, a box one for each input and one for its result.
struct Pin {
  ir::MarkKind kind = ir::MarkKind::Contact;
  std::string text; // as in ir::Mark
};

enum class ElementKind : uint8_t { Contact, Coil, Box };

struct Element {
  ElementKind kind = ElementKind::Contact;
  uint32_t rung = 0;     // in Elements::rungs
  uint32_t line = 0;     // from 1, in the file of its rung
  uint32_t column = 0;   // from 1, in characters: the bracket or the command that begins the element
  std::vector<Pin> pins; // at least one
  uint32_t firstPin = 0; // number of pins[0] over all elements
};

// A rung of the source.
struct SourceRung {
  uint32_t number = 0; // as drawn, from 1
  std::string title;
  std::string routine;
  std::string file; // as given to the compiler; "": unknown
  uint32_t line = 0;
  uint32_t firstElement = 0, elementCount = 0;
  std::vector<uint32_t> lowered; // the rungs of the module, over all routines
};

// A pin in a rung of the module.
struct Point {
  uint32_t pin = 0;   // over all elements
  uint32_t value = 0; // of the rung, a bit
  std::vector<report::Guard> guards;
};

class Elements {
public:
  // `module`: as the front end built it, or with routines inlined. Keeps no reference to it.
  Elements(const ir::Module& module, const ir::Marks& marks);

  std::span<const SourceRung> rungs() const { return rungs_; } // in the order of the module
  std::span<const Element> all() const { return elements_; }   // those of a rung are together
  uint32_t pinCount() const { return static_cast<uint32_t>(elementOfPin_.size()); }
  uint32_t elementOfPin(uint32_t pin) const { return elementOfPin_[pin]; }
  // For a rung of the module, counted over all routines as built: the rung of the source, kNone for one that the
  // compiler made; and the points, in the order of evaluation.
  uint32_t rungOf(uint32_t lowered) const { return codes_[lowered].rung; }
  std::span<const Point> points(uint32_t lowered) const { return codes_[lowered].points; }
  uint32_t loweredCount() const { return static_cast<uint32_t>(codes_.size()); }

private:
  struct Code {
    uint32_t rung = kNone;
    std::vector<Point> points;
  };
  std::vector<SourceRung> rungs_;
  std::vector<Element> elements_;
  std::vector<uint32_t> elementOfPin_;
  std::vector<Code> codes_;
  friend class ElementsBuilder;
};

} // namespace rung::replay
