// A rung as a graph: contacts, coils and boxes, and the nets between them, for any dialect and from any source
// (frontend/ladder/text reads drawings). Names, operands and mnemonics remain text, which lives as long as its source;
// the dialect interprets them and has all rules that need its instruction table.
//
// Nets. Everything that wires connect is one net. Net 0 of a rung is the left rail. A net has power if one of its
// drivers passes power. Net ids and element ids are counted per rung. Elements are in the order of evaluation: an
// element follows all elements that drive its inputs; among those that are ready the first in the source precedes.
// There are no loops (power-loop is an error). A rung with an error in its wires has bad == true and was reported. It
// keeps the elements that could be read, in source order, and an Error for each unreadable one; its nets are undefined.
//
// A reader makes elements with their operands and pins, and nets without links; then it calls linkNets, checkPower,
// checkClosed, orderElements.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/syntax/word_lexer.h"
#include "frontend/table/instruction.h"
#include "ir/support/diagnostics.h"
#include "ir/support/ids.h"
#include "ir/support/source.h"

namespace rung::frontend::ladder {

using NetId = Id<struct NetTag>;
using ElementId = Id<struct ElementTag>;

inline constexpr NetId kRail{0};
inline constexpr NetId kNoNet{};

/// Error: an unreadable part, up to the end of its bracket or line.
enum class ElementKind : uint8_t { Contact, Coil, Box, Error };
enum class CoilKind : uint8_t { Plain, Negated, Set, Reset };

/// First index and number of items in one of the rung's pools.
struct Slice {
  uint32_t first = 0;
  uint32_t count = 0;
};

struct Pin {
  std::string_view name; ///< empty for the first pin: it is not named in the drawing
  NetId input;
  SourceRange range; ///< the element, or the line of the box that names the pin
};

struct Element {
  ElementKind kind = ElementKind::Contact;
  bool negated = false;            ///< contact: [/x]
  char edge = 0;                   ///< '@' or '%' before the operand of a contact or coil, 0 for none
  CoilKind coil = CoilKind::Plain; ///< coils only
  std::string_view mnemonic;       ///< boxes only
  SourceRange mnemonicRange;       ///< boxes only
  Slice operands;                  ///< contact and coil: exactly one, Error: none; see Rung::operandsOf
  Slice pins;                      ///< at least one; see Rung::pinsOf
  NetId output = kNoNet;           ///< kNoNet when nothing is connected on the right
  SourceRange range;               ///< with its brackets; a box: its first line
  uint32_t line = 0;               ///< of `range`, from 1
  uint32_t column = 0;             ///< of `range`, from 1, in characters
};

struct Net {
  SourceRange range; ///< a position for reports: its first wire, or an element that it touches
  Slice drivers;     ///< see Rung::driversOf
  Slice consumers;   ///< see Rung::consumersOf
};

/// A comment on a separate line, or after a line of a drawing.
struct Comment {
  std::string_view text; ///< without blanks at its ends
  SourceRange range;     ///< with the ';'
  uint32_t line = 0;
  bool alone = false; ///< the only thing on its line
};

struct Rung {
  bool bad = false;
  bool hasComment = false;
  std::string_view comment;     ///< the text after the word `rung`
  SourceRange statement;        ///< the `rung` statement itself
  SourceRange range;            ///< from the word `rung` to the end of the last drawing line
  uint32_t firstLine = 0;       ///< the line of the word `rung`
  uint32_t lastLine = 0;        ///< the last line of the drawing
  uint32_t module = UINT32_MAX; ///< index in its source; UINT32_MAX outside of any module (reported)

  std::vector<Comment> comments; ///< from the line after `statement` to the last line of the drawing
  std::vector<Element> elements; ///< in order of evaluation
  std::vector<Net> nets;         ///< nets[0] is the left rail, also if no element touches it
  std::vector<Word> operandPool;
  std::vector<Pin> pinPool;
  std::vector<ElementId> linkPool; ///< drivers and consumers of all nets

  const Element& element(ElementId id) const { return elements[id.index]; }
  std::span<const Word> operandsOf(const Element& e) const {
    return std::span(operandPool).subspan(e.operands.first, e.operands.count);
  }
  /// The operand of a contact or coil, without negation and edge.
  const Word& operandOf(const Element& e) const { return operandPool[e.operands.first]; }
  std::span<const Pin> pinsOf(const Element& e) const { return std::span(pinPool).subspan(e.pins.first, e.pins.count); }
  /// The net at the first pin.
  NetId inputOf(const Element& e) const { return pinPool[e.pins.first].input; }
  /// The elements whose output is this net, in order of evaluation. The rail has no drivers and always has power.
  std::span<const ElementId> driversOf(NetId net) const { return links(nets[net.index].drivers); }
  /// The elements with an input on this net, in order of evaluation; an element with two such pins appears twice.
  std::span<const ElementId> consumersOf(NetId net) const { return links(nets[net.index].consumers); }

private:
  std::span<const ElementId> links(Slice s) const { return std::span(linkPool).subspan(s.first, s.count); }
};

/// Fills the drivers and consumers of all nets, which must be numbered.
void linkNets(Rung& rung);

/// Power comes from the left rail: reports elements that feed themselves or the rail, and nets without a driver. False
/// if there are any. The nets must be linked.
bool checkPower(const Rung& rung, Diagnostics& diagnostics);

/// Reports nets without a consumer. False if there are any. The nets must be linked.
bool checkClosed(const Rung& rung, Diagnostics& diagnostics);

/// Puts the elements into the order of evaluation; if they form a loop, sets Rung::bad and reports it. The nets must be
/// linked.
void orderElements(Rung& rung, Diagnostics& diagnostics);

/// An element in its brackets, as written, without unneeded blanks.
std::string elementText(const Element& element, std::span<const Word> operands);

/// One line per element: `e2 [/STOP] n1 -> n2`, pins after the first as `R=n3`, `.` for no output. Its comments follow.
std::string dumpRung(const Rung& rung);

// The pins of a drawing, compared with the rows of a dialect.

/// Whether the dialect considers two pin names equal.
using SameName = bool (*)(std::string_view a, std::string_view b);

/// Compares the pins of a box with those of its row: reports missing and unknown ones.
bool checkPins(const frontend::InstructionInfo& info, std::span<const Pin> drawn, SourceRange box, SameName same,
               Diagnostics& diagnostics);

/// Whether a pin is at the left rail although its element needs a condition, or is not although it takes none. The
/// dialect reports it.
bool isMisplaced(const frontend::InstructionInfo& info, const Pin& pin);

} // namespace rung::frontend::ladder
