// The drawing of one rung as tokens, line by line; shared by the scanner, the wiring, and code that draws a rung again
// (readDrawing); all else is internal to frontend/ladder/text.
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

/// The result of the scanner, in text order. Its vectors are reused from rung to rung.
struct Drawing {
  std::vector<DrawnLine> lines;
  std::vector<Token> tokens;
  std::vector<Element> elements; ///< including pin lines; pins and outputs are not filled in yet
  std::vector<uint32_t> headOf;  ///< per element: the box whose pin line it is, kNone for a separate element
  std::vector<uint32_t> nextPin; ///< per element: the next pin line of the same box, or kNone
  std::vector<Word> operands;
  std::vector<Comment> comments; ///< comments after its lines, and those between them if the parser adds them
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

/// Whether a line that begins with this character, after blanks, belongs to a drawing.
constexpr bool beginsDrawing(char c) { return std::string_view("|+-[({").find(c) != std::string_view::npos; }

/// The lines of a drawing without errors in new columns: elements connected by `--`, branches as long as the longest
/// one between the same joints. Nothing if that takes too long to compute.
std::optional<std::vector<std::string>> layOut(const Drawing& drawing);

/// Scans the drawing of a correct rung of this file again, with its pin lines.
Drawing readDrawing(const SourceManager& sources, FileId file, const Rung& rung, FindBox findBox);

/// Adds a line to the drawing. A mistake sets drawing.bad; the unreadable part, an element or the rest of the line,
/// becomes an Error.
void scanDrawingLine(const SourceLine& line, Drawing& drawing, Diagnostics& diagnostics);

/// Adds an unreadable line, which was reported, as an Error; sets drawing.bad.
void addUnreadLine(const SourceLine& line, Drawing& drawing);

/// Removes a drawn right rail.
void dropRightRail(Drawing& drawing);

/// Finds the pin lines of boxes: fills headOf and nextPin.
void groupPins(Drawing& drawing, FindBox findBox, Diagnostics& diagnostics);

/// Connects the wires: fills the rung's elements (in text order), pins and nets, also for a bad drawing.
void wireUp(Drawing& drawing, Rung& rung, Diagnostics& diagnostics);

/// Offset of the first character in [begin, end) that is not printable ASCII, or end.
size_t findUnprintable(std::string_view text, size_t begin, size_t end);

} // namespace rung::frontend::ladder
