// The drawing of one rung as tokens, line by line; shared by the scanner, the wiring, and who
// draws a rung again (readDrawing); all else is internal to frontend/ladder/text.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/ladder/text/ladder_file.h"

namespace rung::frontend::ladder {

inline constexpr uint32_t kNone = UINT32_MAX;

enum class TokenKind : uint8_t {
  Rail,    ///< `|` in column 0
  Bar,     ///< `|` elsewhere: a vertical wire
  Wire,    ///< a run of `-` and `+`
  Element, ///< from bracket to bracket
};

struct Token {
  TokenKind kind;
  uint32_t begin;   ///< offsets in the line, in bytes
  uint32_t end;     ///< after the last byte
  uint32_t column;  ///< of the first character, from 0; wires meet by columns, not by bytes
  uint32_t element; ///< Element: index into Drawing::elements
};

struct DrawnLine {
  SourceLine source;
  Slice tokens;
};

/// What the scanner finds, in the order of the text. Its vectors are reused from rung to rung.
struct Drawing {
  std::vector<DrawnLine> lines;
  std::vector<Token> tokens;
  std::vector<Element> elements; ///< pin lines included; pins and outputs are not filled in yet
  std::vector<uint32_t> headOf;  ///< per element: the box whose pin line it is, kNone for an element of its own
  std::vector<uint32_t> nextPin; ///< per element: the next pin line of the same box, or kNone
  std::vector<Word> operands;
  std::vector<Comment> comments; ///< after its lines; with those between them where the parser adds them
  bool bad = false;              ///< an error was reported

  void clear();
  std::span<const Token> tokensOf(const DrawnLine& line) const {
    return std::span(tokens).subspan(line.tokens.first, line.tokens.count);
  }
  bool isPinLine(uint32_t element) const { return headOf[element] != kNone; }
  std::span<const Word> operandsOf(const Element& element) const {
    return std::span(operands).subspan(element.operands.first, element.operands.count);
  }
};

/// The comment of a line from its ';' on.
Comment commentFrom(const SourceLine& line, size_t begin);

/// Whether a line that begins with this character, after blanks, is one of a drawing.
constexpr bool beginsDrawing(char c) { return std::string_view("|+-[({").find(c) != std::string_view::npos; }

/// The lines of a drawing without errors in new columns: elements joined by `--`, branches as long as the longest
/// one that joins them. Nothing where that takes too long to find.
std::optional<std::vector<std::string>> layOut(const Drawing& drawing);

/// The drawing of a rung of this file that is not bad, once more, with its pin lines found.
Drawing readDrawing(const SourceManager& sources, FileId file, const Rung& rung, FindBox findBox);

/// Adds a line to the drawing. A mistake sets drawing.bad; what could not be read, an element or the rest of the line,
/// is an Error.
void scanDrawingLine(const SourceLine& line, Drawing& drawing, Diagnostics& diagnostics);

/// Adds a line that cannot be read, which was reported, as an Error; sets drawing.bad.
void addUnreadLine(const SourceLine& line, Drawing& drawing);

/// Takes out what is drawn of a right rail.
void dropRightRail(Drawing& drawing);

/// Finds the pin lines of boxes: fills headOf and nextPin.
void groupPins(Drawing& drawing, FindBox findBox, Diagnostics& diagnostics);

/// Joins the wires: fills the rung's elements (in the order of the text), pins and nets, also of a bad drawing.
void wireUp(Drawing& drawing, Rung& rung, Diagnostics& diagnostics);

/// Offset of the first character in [begin, end) that is not printable ASCII, or end.
size_t findUnprintable(std::string_view text, size_t begin, size_t end);

} // namespace rung::frontend::ladder
