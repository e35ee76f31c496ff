// The right rail, which need not be drawn: a `|` after the coils and boxes that end their lines. It carries nothing, so
// its tokens are taken out, and what is left is the drawing without it. A `|` after a wire would be an error otherwise.
#include <algorithm>

#include "frontend/ladder/text/drawing.h"

namespace rung::frontend::ladder {
namespace {

class RightRail {
public:
  explicit RightRail(Drawing& drawing) : drawing_(drawing) {}

  void drop() {
    for (const DrawnLine& line : drawing_.lines)
      if (touchedTokens(line) != 0) columns_.push_back(drawing_.tokensOf(line).back().column);
    if (columns_.empty()) return;
    for (DrawnLine& line : drawing_.lines) shorten(line);
  }

private:
  uint32_t touchedTokens(const DrawnLine& line) const;
  bool endsLine(const Token& token, const DrawnLine& line) const;
  void shorten(DrawnLine& line) const;
  bool isPlainWire(const DrawnLine& line, const Token& token) const {
    return token.kind == TokenKind::Wire &&
           line.source.text.substr(token.begin, token.end - token.begin).find('+') == std::string_view::npos;
  }
  bool isLastBar(const DrawnLine& line) const {
    const std::span<const Token> tokens = drawing_.tokensOf(line);
    return tokens.size() > 1 && tokens.back().kind == TokenKind::Bar;
  }

  Drawing& drawing_;
  std::vector<uint32_t> columns_;
};

/// After a coil nothing else can be meant. A box may have an output: its `|` must be right of all that is drawn.
bool RightRail::endsLine(const Token& token, const DrawnLine& line) const {
  if (token.kind != TokenKind::Element) return false;
  const ElementKind kind = drawing_.elements[token.element].kind;
  if (kind != ElementKind::Box) return kind == ElementKind::Coil;
  const uint32_t rail = drawing_.tokensOf(line).back().column;
  return std::ranges::all_of(drawing_.lines, [&](const DrawnLine& other) {
    const std::span<const Token> tokens = drawing_.tokensOf(other);
    return tokens.empty() || tokens.back().column + (tokens.back().end - tokens.back().begin) <= rail + 1;
  });
}

/// How many tokens at the end of the line are the rail and the wire to it; 0 where it does not end so.
uint32_t RightRail::touchedTokens(const DrawnLine& line) const {
  if (!isLastBar(line)) return 0;
  const std::span<const Token> tokens = drawing_.tokensOf(line);
  size_t last = tokens.size() - 1;
  const auto touches = [&](size_t at) { return at > 0 && tokens[at - 1].end == tokens[at].begin; };
  if (!touches(last)) return 0;
  if (isPlainWire(line, tokens[last - 1]) && touches(last - 1)) --last;
  return endsLine(tokens[last - 1], line) ? static_cast<uint32_t>(tokens.size() - last) : 0;
}

/// A line that does not reach the rail has its `|` alone, in a column of others.
void RightRail::shorten(DrawnLine& line) const {
  const uint32_t touched = touchedTokens(line);
  if (touched != 0)
    line.tokens.count -= touched;
  else if (isLastBar(line) && std::ranges::find(columns_, drawing_.tokensOf(line).back().column) != columns_.end())
    --line.tokens.count;
}

} // namespace

void dropRightRail(Drawing& drawing) { RightRail(drawing).drop(); }

} // namespace rung::frontend::ladder
