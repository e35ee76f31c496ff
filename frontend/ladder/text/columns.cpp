// Assigns new columns to a drawing. An atom, a mark (`+`, `|`) or an element, is the unit that has a column. Atoms that
// must stay one below the other, joined marks and the lines of a box, form a group and share a column. The order of
// atoms on a line does not change, so each group is placed as far to the left as the groups before it allow. If that
// aligns marks that are not joined in the source, their groups are separated and the placement starts again.
#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontend/ladder/text/drawing.h"
#include "ir/support/utf8.h"

namespace rung::frontend::ladder {
namespace {

constexpr uint32_t kStart = 3;    // the first column after "|--"
constexpr uint32_t kGap = 2;      // minimum between atoms: a wire `--`, or blanks
constexpr uint32_t kApart = 3;    // distance between marks that must not join
constexpr uint32_t kMaxPad = 100; // longer boxes do not pull their pin lines along
constexpr int kMaxRounds = 200;   // a drawing that needs more was not made by a person

enum class Shape : uint8_t { Mark, Box, OneWordBox, Other };

struct Atom {
  std::string text;
  uint32_t drawn; // column in the source
  uint32_t width;
  uint32_t group = 0;
  Shape shape = Shape::Mark;
  bool wired = false; // connected to the atom on its left
};

struct Group {
  uint32_t drawn;
  uint32_t column = 0;
  std::vector<uint32_t> apart; // groups that must stay on its left
};

class Columns {
public:
  explicit Columns(const Drawing& drawing) : drawing_(drawing) {}

  std::optional<std::vector<std::string>> run() {
    for (const DrawnLine& line : drawing_.lines) read(line);
    lineBegins_.push_back(atoms_.size());
    order_.resize(atoms_.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::ranges::stable_sort(order_, {}, [&](size_t atom) { return atoms_[atom].drawn; });
    for (int round = 0; round < kMaxRounds; ++round) {
      place();
      if (!separate()) return lines();
    }
    return std::nullopt;
  }

private:
  using Atoms = std::span<const Atom>;

  void read(const DrawnLine& line);
  void readWire(const DrawnLine& line, const Token& token, bool touches);
  void readElement(const Token& token, bool touches);
  void add(Atom atom, bool isPinLine = false);
  uint32_t groupAbove(const Atom& atom, bool isPinLine) const;
  void place();
  bool separate();
  bool meet(const Atom& above, const Atom& below);
  std::vector<std::string> lines() const;
  std::string text(Atoms line) const;

  bool isFirst(size_t atom) const { return std::ranges::binary_search(lineBegins_, atom); }
  Atoms lineAt(size_t line) const {
    return Atoms(atoms_).subspan(lineBegins_[line], lineBegins_[line + 1] - lineBegins_[line]);
  }
  uint32_t columnOf(const Atom& atom) const { return groups_[atom.group].column; }

  const Drawing& drawing_;
  std::vector<Atom> atoms_; // line by line, from left to right
  std::vector<size_t> lineBegins_;
  std::vector<Group> groups_;
  std::vector<size_t> order_; // indices of atoms, sorted by their columns in the source
};

void Columns::read(const DrawnLine& line) {
  lineBegins_.push_back(atoms_.size());
  const std::span<const Token> tokens = drawing_.tokensOf(line);
  for (size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    const bool touches = i > 0 && tokens[i - 1].end == token.begin;
    switch (token.kind) {
    case TokenKind::Rail:
    case TokenKind::Bar: add({.text = "|", .drawn = token.column, .width = 1}); break;
    case TokenKind::Wire: readWire(line, token, touches); break;
    case TokenKind::Element: readElement(token, touches); break;
    }
  }
}

void Columns::readWire(const DrawnLine& line, const Token& token, bool touches) {
  for (uint32_t at = token.begin; at < token.end; ++at)
    if (line.source.text[at] == '+')
      add({.text = "+", .drawn = token.column + (at - token.begin), .width = 1, .wired = touches || at > token.begin});
}

void Columns::readElement(const Token& token, bool touches) {
  const Element& element = drawing_.elements[token.element];
  const bool isBox = element.kind == ElementKind::Box;
  Atom atom{.text = elementText(element, drawing_.operandsOf(element)),
            .drawn = token.column,
            .width = 0,
            .shape = !isBox                        ? Shape::Other
                     : element.operands.count == 0 ? Shape::OneWordBox
                                                   : Shape::Box,
            .wired = touches};
  const bool isPinLine = drawing_.isPinLine(token.element);
  if (isPinLine) {
    const Element& box = drawing_.elements[drawing_.headOf[token.element]];
    const size_t wide = countCodePoints(elementText(box, drawing_.operandsOf(box)));
    if (wide <= kMaxPad && wide > atom.text.size())
      atom.text.insert(atom.text.size() - 1, wide - atom.text.size(), ' ');
  }
  atom.width = static_cast<uint32_t>(countCodePoints(atom.text));
  add(std::move(atom), isPinLine);
}

void Columns::add(Atom atom, bool isPinLine) {
  atom.group = groupAbove(atom, isPinLine);
  if (atom.group == kNone) {
    atom.group = static_cast<uint32_t>(groups_.size());
    groups_.push_back({.drawn = atom.drawn, .apart = {}});
  }
  atoms_.push_back(std::move(atom));
}

// Group of the atom above if the two belong together; otherwise kNone.
uint32_t Columns::groupAbove(const Atom& atom, bool isPinLine) const {
  const size_t line = lineBegins_.size() - 1;
  if (line == 0 || (atom.shape != Shape::Mark && !isPinLine)) return kNone;
  const Atoms above = Atoms(atoms_).subspan(lineBegins_[line - 1], lineBegins_[line] - lineBegins_[line - 1]);
  const auto at = std::ranges::lower_bound(above, atom.drawn, {}, &Atom::drawn);
  if (at == above.end() || at->drawn != atom.drawn) return kNone;
  return isPinLine || at->shape == Shape::Mark ? at->group : kNone;
}

// Places each group as far to the left as possible. The atoms on its left come first in order_, so they are already
// placed.
void Columns::place() {
  for (Group& group : groups_) group.column = group.drawn == 0 ? 0 : kStart;
  for (const size_t i : order_) {
    Group& group = groups_[atoms_[i].group];
    if (!isFirst(i)) group.column = std::max(group.column, columnOf(atoms_[i - 1]) + atoms_[i - 1].width + kGap);
    for (const uint32_t left : group.apart) group.column = std::max(group.column, groups_[left].column + kApart);
  }
}

// Separates groups that would join by accident; returns whether there were any.
bool Columns::separate() {
  bool found = false;
  for (size_t line = 1; line + 1 < lineBegins_.size(); ++line) {
    const Atoms above = lineAt(line - 1);
    auto at = above.begin();
    for (const Atom& below : lineAt(line)) {
      while (at != above.end() && columnOf(*at) < columnOf(below)) ++at;
      if (at != above.end() && columnOf(*at) == columnOf(below) && meet(*at, below)) found = true;
    }
  }
  return found;
}

// Separates two atoms of neighbouring lines in one column if they would form a joint that the source does not have.
bool Columns::meet(const Atom& above, const Atom& below) {
  const bool marks = above.shape == Shape::Mark && below.shape == Shape::Mark;
  const bool pin = below.shape == Shape::OneWordBox && above.shape != Shape::Mark && above.shape != Shape::Other;
  if (above.group == below.group || above.drawn == below.drawn || (!marks && !pin)) return false;
  const bool isAboveLeft = above.drawn < below.drawn;
  groups_[(isAboveLeft ? below : above).group].apart.push_back((isAboveLeft ? above : below).group);
  return true;
}

std::vector<std::string> Columns::lines() const {
  std::vector<std::string> result;
  for (size_t line = 0; line + 1 < lineBegins_.size(); ++line) result.push_back(text(lineAt(line)));
  return result;
}

std::string Columns::text(Atoms line) const {
  std::string result;
  uint32_t column = 0;
  for (const Atom& atom : line) {
    result.append(columnOf(atom) - column, atom.wired ? '-' : ' ');
    result += atom.text;
    column = columnOf(atom) + atom.width;
  }
  return result;
}

} // namespace

std::optional<std::vector<std::string>> layOut(const Drawing& drawing) { return Columns(drawing).run(); }

} // namespace rung::frontend::ladder
