// Turns tokens into nets. Wires, vertical bars and the joints between neighbouring elements are nodes of a union-find
// structure; a net is one of its classes. Each line yields at most one error, because several problems on a line mostly
// have one cause.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "frontend/ladder/text/drawing.h"
#include "ir/support/diag/ladder.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::ladder {
namespace {

constexpr uint32_t kRailNode = 0;

/// A `+`, a `|` or the rail: a point where wires of neighbouring lines can join.
struct Mark {
  uint32_t column = 0;
  uint32_t node = 0;
  uint32_t line = 0;   ///< index into Drawing::lines
  uint32_t token = 0;  ///< index into Drawing::tokens
  uint32_t offset = 0; ///< byte offset in the line
  bool up = false;
  bool down = false;
};

class Wiring {
public:
  Wiring(Drawing& drawing, Rung& rung, Diagnostics& diagnostics)
      : drawing_(drawing), rung_(rung), diagnostics_(diagnostics) {}

  void run() {
    // Node 0 is the rail, node i + 1 belongs to token i.
    parent_.resize(drawing_.tokens.size() + 1);
    std::iota(parent_.begin(), parent_.end(), 0u);
    inputs_.assign(drawing_.elements.size(), kNone);
    outputs_.assign(drawing_.elements.size(), kNone);
    reported_.assign(drawing_.lines.size(), false);
    for (uint32_t i = 0; i < drawing_.lines.size(); ++i) joinLine(i);
    joinColumns();
    for (const Mark& mark : marks_) checkMark(mark);
    for (uint32_t& input : inputs_)
      if (input == kNone) input = newNode(); // already reported, or part of a bad drawing
    makeElements();
    linkNets(rung_);
    if (!drawing_.bad) checkNets();
  }

private:
  static uint32_t nodeOf(uint32_t token) { return token + 1; }
  uint32_t find(uint32_t node);
  void unite(uint32_t a, uint32_t b);
  uint32_t newNode();

  void joinLine(uint32_t line);
  void connect(uint32_t line, uint32_t left, uint32_t right);
  void leftEnd(uint32_t line, uint32_t token);
  void rightEnd(uint32_t line, uint32_t token);
  void addMarks(uint32_t line, uint32_t token);
  void joinColumns();
  void checkMark(const Mark& mark);

  NetId netOf(uint32_t node);
  void makeElements();
  void addPin(uint32_t drawnElement, std::string_view name);
  void checkNets();
  void checkOpenEnds();
  bool onlyCoilsDrive(NetId net) const;

  void loose(uint32_t line, size_t begin, size_t end, std::string_view what);
  SourceRange rangeOf(uint32_t line, const Token& token) const {
    return drawing_.lines[line].source.range(token.begin, token.end);
  }

  Drawing& drawing_;
  Rung& rung_;
  Diagnostics& diagnostics_;
  std::vector<uint32_t> parent_;
  std::vector<uint32_t> inputs_;  ///< node per drawn element
  std::vector<uint32_t> outputs_; ///< node per drawn element, or kNone
  std::vector<Mark> marks_;       ///< sorted by line and column
  std::vector<bool> reported_;    ///< per line
  std::vector<NetId> netOfRoot_;

  struct OpenEnd {
    uint32_t line;
    uint32_t token;
  };
  /// A '+' with its column, and the column of the branch end that joins nothing; columns count from 0.
  struct Join {
    SourceRange place;
    uint32_t column;
    uint32_t here;
  };
  std::optional<Join> nearestJoin(const OpenEnd& end) const;
  /// A wire is ASCII, so each byte is one column.
  static uint32_t columnOf(const Token& wire, uint32_t offset) { return wire.column + (offset - wire.begin); }

  std::vector<OpenEnd> openEnds_; ///< wires without anything on their right
};

uint32_t Wiring::find(uint32_t node) {
  while (parent_[node] != node) {
    parent_[node] = parent_[parent_[node]];
    node = parent_[node];
  }
  return node;
}

/// The smaller root stays the root, so the rail is always the root of its own class.
void Wiring::unite(uint32_t a, uint32_t b) {
  a = find(a);
  b = find(b);
  if (a < b) {
    parent_[b] = a;
  } else {
    parent_[a] = b;
  }
}

uint32_t Wiring::newNode() {
  parent_.push_back(static_cast<uint32_t>(parent_.size()));
  return parent_.back();
}

void Wiring::loose(uint32_t line, size_t begin, size_t end, std::string_view what) {
  drawing_.bad = true;
  if (reported_[line]) return;
  reported_[line] = true;
  diagnostics_.report(diag::DanglingWire, drawing_.lines[line].source.range(begin, end)) << what;
}

void Wiring::joinLine(uint32_t line) {
  const Slice slice = drawing_.lines[line].tokens;
  for (uint32_t i = slice.first; i < slice.first + slice.count; ++i) {
    const Token& token = drawing_.tokens[i];
    const bool touchesLeft = i > slice.first && drawing_.tokens[i - 1].end == token.begin;
    const bool last = i + 1 == slice.first + slice.count;
    if (touchesLeft) {
      connect(line, i - 1, i);
    } else {
      leftEnd(line, i);
    }
    if (last || drawing_.tokens[i + 1].begin != token.end) rightEnd(line, i);
    addMarks(line, i);
  }
}

/// Connects two adjacent tokens. They are never both wires: those would be one token.
void Wiring::connect(uint32_t line, uint32_t left, uint32_t right) {
  const Token& a = drawing_.tokens[left];
  const Token& b = drawing_.tokens[right];
  if (a.kind == TokenKind::Bar || b.kind == TokenKind::Bar) {
    const bool barIsRight = b.kind == TokenKind::Bar;
    const bool first = left == drawing_.lines[line].tokens.first;
    loose(line, a.begin, b.end,
          barIsRight ? "this ends at a vertical wire; write '+' instead of '|' to join it"
          : first    ? "this begins at a vertical wire; write '+' instead of '|' to join it, or put the rail into the "
                       "first column"
                     : "this begins at a vertical wire; write '+' instead of '|' to join it");
    return;
  }
  if (a.kind == TokenKind::Element && drawing_.isPinLine(a.element)) {
    loose(line, b.begin, b.end, "the output of a box is on its first line, not after a pin");
    return;
  }
  uint32_t node = kRailNode;
  if (a.kind == TokenKind::Wire) {
    node = nodeOf(left);
  } else if (a.kind == TokenKind::Element) {
    node = b.kind == TokenKind::Wire ? nodeOf(right) : newNode();
    outputs_[a.element] = node;
  }
  if (b.kind == TokenKind::Element) {
    inputs_[b.element] = node;
  } else if (a.kind == TokenKind::Rail) {
    unite(kRailNode, nodeOf(right));
  }
}

void Wiring::leftEnd(uint32_t line, uint32_t token) {
  const Token& t = drawing_.tokens[token];
  const char first = drawing_.lines[line].source.text[t.begin];
  if (t.kind == TokenKind::Element) loose(line, t.begin, t.end, "nothing is connected on the left of this element");
  if (t.kind == TokenKind::Wire && first == '-') loose(line, t.begin, t.end, "this wire has nothing on its left");
}

/// Records an open end. Whether it is an error by itself or ends the whole branch is known only after the nets.
void Wiring::rightEnd(uint32_t line, uint32_t token) {
  const Token& t = drawing_.tokens[token];
  if (t.kind == TokenKind::Wire && drawing_.lines[line].source.text[t.end - 1] == '-')
    openEnds_.push_back({line, token});
}

void Wiring::addMarks(uint32_t line, uint32_t token) {
  const Token& t = drawing_.tokens[token];
  const std::string_view text = drawing_.lines[line].source.text;
  switch (t.kind) {
  case TokenKind::Element: return;
  case TokenKind::Rail: marks_.push_back({t.column, kRailNode, line, token, t.begin}); return;
  case TokenKind::Bar: marks_.push_back({t.column, nodeOf(token), line, token, t.begin}); return;
  case TokenKind::Wire:
    for (uint32_t at = t.begin; at < t.end; ++at) {
      if (text[at] == '+') marks_.push_back({t.column + at - t.begin, nodeOf(token), line, token, at});
    }
    return;
  }
}

/// Joins marks that are in the same column of neighbouring lines.
void Wiring::joinColumns() {
  size_t above = 0;
  for (size_t here = 0; here < marks_.size(); ++here) {
    Mark& mark = marks_[here];
    while (marks_[above].line + 1 < mark.line ||
           (marks_[above].line + 1 == mark.line && marks_[above].column < mark.column)) {
      ++above;
    }
    Mark& other = marks_[above];
    if (other.line + 1 != mark.line || other.column != mark.column) continue;
    other.down = true;
    mark.up = true;
    unite(other.node, mark.node);
  }
}

/// Checks that a `|` continues above and below and that a `+` joins at least two things.
void Wiring::checkMark(const Mark& mark) {
  const Token& token = drawing_.tokens[mark.token];
  const Slice slice = drawing_.lines[mark.line].tokens;
  if (token.kind == TokenKind::Rail) return;
  if (token.kind == TokenKind::Bar) {
    if (mark.up && mark.down) return;
    loose(mark.line, mark.offset, mark.offset + 1,
          mark.up ? "this vertical wire has nothing below it" : "this vertical wire has nothing above it");
    return;
  }
  const bool first = mark.offset == token.begin;
  const bool last = mark.offset + 1 == token.end;
  const bool left = !first || (mark.token > slice.first && drawing_.tokens[mark.token - 1].end == token.begin);
  const bool right =
      !last || (mark.token + 1 < slice.first + slice.count && drawing_.tokens[mark.token + 1].begin == token.end);
  if (mark.up + mark.down + left + right >= 2) return;
  if (left) {
    openEnds_.push_back({mark.line, mark.token});
  } else {
    loose(mark.line, mark.offset, mark.offset + 1,
          "this '+' joins nothing; there is no '+' or '|' in its column on the "
          "lines above and below");
  }
}

NetId Wiring::netOf(uint32_t node) {
  NetId& net = netOfRoot_[find(node)];
  if (!net.valid()) {
    net.index = static_cast<uint32_t>(rung_.nets.size());
    rung_.nets.emplace_back();
  }
  return net;
}

void Wiring::addPin(uint32_t drawnElement, std::string_view name) {
  rung_.pinPool.push_back({name, netOf(inputs_[drawnElement]), drawing_.elements[drawnElement].range});
}

/// Copies the drawn elements; pin lines are merged into their boxes.
void Wiring::makeElements() {
  netOfRoot_.assign(parent_.size(), kNoNet);
  netOf(kRailNode);
  rung_.operandPool = drawing_.operands;
  rung_.elements.reserve(drawing_.elements.size());
  for (uint32_t i = 0; i < drawing_.elements.size(); ++i) {
    if (drawing_.isPinLine(i)) continue;
    Element element = drawing_.elements[i];
    element.pins.first = static_cast<uint32_t>(rung_.pinPool.size());
    addPin(i, {});
    for (uint32_t pin = drawing_.nextPin[i]; pin != kNone; pin = drawing_.nextPin[pin])
      addPin(pin, drawing_.elements[pin].mnemonic);
    element.pins.count = static_cast<uint32_t>(rung_.pinPool.size()) - element.pins.first;
    if (outputs_[i] != kNone) element.output = netOf(outputs_[i]);
    rung_.elements.push_back(element);
  }
  for (uint32_t line = 0; line < drawing_.lines.size(); ++line) {
    const Slice slice = drawing_.lines[line].tokens;
    for (uint32_t i = slice.first; i < slice.first + slice.count; ++i) {
      if (drawing_.tokens[i].kind != TokenKind::Wire) continue;
      Net& net = rung_.nets[netOf(nodeOf(i)).index];
      if (!net.range.valid()) net.range = rangeOf(line, drawing_.tokens[i]);
    }
  }
  for (const Element& element : rung_.elements) {
    for (const Pin& pin : rung_.pinsOf(element)) {
      Net& net = rung_.nets[pin.input.index];
      if (!net.range.valid()) net.range = pin.range;
    }
  }
}

bool Wiring::onlyCoilsDrive(NetId net) const {
  for (const ElementId id : rung_.driversOf(net)) {
    if (rung_.element(id).kind != ElementKind::Coil) return false;
  }
  return !rung_.driversOf(net).empty();
}

/// Checks wires with an open end: the branch lacks its closing element or, if the net has other consumers, is too long.
void Wiring::checkOpenEnds() {
  for (const OpenEnd& end : openEnds_) {
    const NetId net = netOf(nodeOf(end.token));
    const SourceRange range = rangeOf(end.line, drawing_.tokens[end.token]);
    if (!rung_.consumersOf(net).empty()) {
      loose(end.line, drawing_.tokens[end.token].begin, drawing_.tokens[end.token].end,
            "this wire has nothing on its right");
    } else if (onlyCoilsDrive(net)) {
      diagnostics_.report(diag::ElementAfterClosing, range) << "a coil";
    } else {
      DiagBuilder report = diagnostics_.report(diag::MissingClosingElement, range);
      report << "this wire";
      if (const auto join = nearestJoin(end))
        report.note(join->place, fmt::format("this '+' is in column {}, the end of the branch in column {}: branches "
                                             "join where one '+' is under the other",
                                             join->column + 1, join->here + 1));
    }
  }
}

/// The nearest '+' on the line above or below that this branch, which ends in a '+', may have been meant to join: a
/// longer name shifts the end of a branch.
std::optional<Wiring::Join> Wiring::nearestJoin(const OpenEnd& end) const {
  const Token& wire = drawing_.tokens[end.token];
  if (drawing_.lines[end.line].source.text[wire.end - 1] != '+') return std::nullopt;
  const uint32_t here = columnOf(wire, wire.end - 1);
  std::optional<Join> nearest;
  uint32_t least = kNone;
  for (const uint32_t line : {end.line - 1, end.line + 1}) { // above line 0 the number wraps around and is out of range
    if (line >= drawing_.lines.size()) continue;
    for (const Token& token : drawing_.tokensOf(drawing_.lines[line])) {
      if (token.kind != TokenKind::Wire) continue;
      for (uint32_t at = token.begin; at < token.end; ++at) {
        const uint32_t column = columnOf(token, at);
        const uint32_t distance = column < here ? here - column : column - here;
        if (drawing_.lines[line].source.text[at] != '+' || distance >= least) continue;
        least = distance;
        nearest = {drawing_.lines[line].source.range(at, at + 1), column, here};
      }
    }
  }
  return nearest;
}

void Wiring::checkNets() {
  drawing_.bad = !checkPower(rung_, diagnostics_);
  if (drawing_.bad) return;
  checkOpenEnds();
  drawing_.bad = !openEnds_.empty() || !checkClosed(rung_, diagnostics_);
}

} // namespace

void wireUp(Drawing& drawing, Rung& rung, Diagnostics& diagnostics) { Wiring(drawing, rung, diagnostics).run(); }

// Determines which boxes are pin lines of the box above them.

namespace {

/// A box and its pin lines so far.
struct Group {
  uint32_t head = kNone;
  uint32_t lastPin = kNone;
  uint32_t pinLines = 0;
  std::optional<std::span<const frontend::PinInfo>> pins; ///< its pins after the first; nullopt if the box is not known

  bool lacksPins() const { return pins && pinLines < pins->size(); }
};

/// One line of a group, with the columns of its braces.
struct Row {
  uint32_t column = 0;
  uint32_t endColumn = 0;
  uint32_t group = 0;
};

class PinGrouper {
public:
  PinGrouper(Drawing& drawing, FindBox findBox, Diagnostics& diagnostics)
      : drawing_(drawing), findBox_(findBox), diagnostics_(diagnostics) {}

  void run() {
    drawing_.headOf.assign(drawing_.elements.size(), kNone);
    drawing_.nextPin.assign(drawing_.elements.size(), kNone);
    for (const DrawnLine& line : drawing_.lines) {
      for (const Token& token : drawing_.tokensOf(line)) {
        if (token.kind == TokenKind::Element) box(line, token);
      }
      above_.swap(here_);
      here_.clear();
    }
  }

private:
  void box(const DrawnLine& line, const Token& token);
  bool isNamed(const Group& group, std::string_view word) const;
  bool accepts(const Group& group, std::string_view word) const;
  const Row* misalignedTo(const DrawnLine& line, const Token& token, std::vector<Row>::const_iterator near) const;
  uint32_t open(uint32_t element);
  void addPin(uint32_t index, uint32_t element);

  Drawing& drawing_;
  const FindBox findBox_;
  Diagnostics& diagnostics_;
  std::vector<Group> groups_;
  std::vector<Row> above_; ///< sorted by column
  std::vector<Row> here_;
};

bool PinGrouper::isNamed(const Group& group, std::string_view word) const {
  return group.pins && std::ranges::any_of(*group.pins, [&](const frontend::PinInfo& pin) {
           return text::equalsIgnoringCase(pin.name, word);
         });
}

/// Whether the group takes this word as a pin. While pins are missing a wrong name counts as an unknown pin, not as
/// another box.
bool PinGrouper::accepts(const Group& group, std::string_view word) const {
  return !group.pins || group.lacksPins() || isNamed(group, word);
}

void PinGrouper::addPin(uint32_t index, uint32_t element) {
  Group& group = groups_[index];
  drawing_.headOf[element] = group.head;
  drawing_.nextPin[group.lastPin == kNone ? group.head : group.lastPin] = element;
  group.lastPin = element;
  ++group.pinLines;
}

uint32_t PinGrouper::open(uint32_t element) {
  Group group;
  group.head = element;
  const frontend::InstructionInfo* row = findBox_ == nullptr ? nullptr : findBox_(drawing_.elements[element].mnemonic);
  if (row != nullptr) group.pins = furtherPinsOf(*row);
  groups_.push_back(group);
  return static_cast<uint32_t>(groups_.size() - 1);
}

/// The row above, left or right of this column, that the box was probably meant to belong to: the word names a pin that
/// is still missing there or, if the pins are not known, the line is padded like a pin line and overlaps that box.
const Row* PinGrouper::misalignedTo(const DrawnLine& line, const Token& token,
                                    std::vector<Row>::const_iterator near) const {
  const std::string_view word = drawing_.elements[token.element].mnemonic;
  const bool padded = line.source.text[token.end - 2] == ' ';
  const uint32_t endColumn = token.column + (token.end - token.begin);
  const auto meant = [&](const Row& row) {
    const Group& group = groups_[row.group];
    if (group.pins) return group.lacksPins() && isNamed(group, word);
    return padded && row.column < endColumn && token.column < row.endColumn;
  };
  if (near != above_.end() && near->column != token.column && meant(*near)) return &*near;
  if (near != above_.begin() && meant(*(near - 1))) return &*(near - 1);
  return nullptr;
}

void PinGrouper::box(const DrawnLine& line, const Token& token) {
  const Element& element = drawing_.elements[token.element];
  if (element.kind != ElementKind::Box) return;
  Row row{token.column, token.column + (token.end - token.begin), kNone};
  if (element.operands.count == 0 && !above_.empty()) {
    const auto near = std::lower_bound(above_.begin(), above_.end(), token.column,
                                       [](const Row& r, uint32_t column) { return r.column < column; });
    const bool aligned = near != above_.end() && near->column == token.column;
    if (aligned && accepts(groups_[near->group], element.mnemonic)) {
      addPin(near->group, token.element);
      row.group = near->group;
    } else if (const Row* meant = misalignedTo(line, token, near)) {
      const SourceRange box = drawing_.elements[groups_[meant->group].head].range;
      diagnostics_.report(diag::MisalignedBox, element.range).label(box, "the box") << meant->column + 1;
      drawing_.bad = true;
      // Continue as if it were in the right column, so that the box is the reference for the lines below.
      addPin(meant->group, token.element);
      row = *meant;
    }
  }
  if (row.group == kNone) row.group = open(token.element);
  here_.push_back(row);
}

} // namespace

void groupPins(Drawing& drawing, FindBox findBox, Diagnostics& diagnostics) {
  PinGrouper(drawing, findBox, diagnostics).run();
}

// The right rail, which is optional: a `|` after the coils and boxes that end their lines. It carries no power, so its
// tokens are removed before the wiring. A `|` after a wire would otherwise be an error.

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

/// Whether the token closes the line. After a coil, a `|` can only be the rail. A box may have an output, so its `|`
/// counts as the rail only at the right of the whole drawing.
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

/// Number of tokens at the end of the line that form the rail and the wire to it; 0 if the line does not end in the
/// rail.
uint32_t RightRail::touchedTokens(const DrawnLine& line) const {
  if (!isLastBar(line)) return 0;
  const std::span<const Token> tokens = drawing_.tokensOf(line);
  size_t last = tokens.size() - 1;
  const auto touches = [&](size_t at) { return at > 0 && tokens[at - 1].end == tokens[at].begin; };
  if (!touches(last)) return 0;
  if (isPlainWire(line, tokens[last - 1]) && touches(last - 1)) --last;
  return endsLine(tokens[last - 1], line) ? static_cast<uint32_t>(tokens.size() - last) : 0;
}

/// Removes the rail from a line. A line that does not reach the rail has a `|` of its own in the same column.
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
