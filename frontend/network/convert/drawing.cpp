// Layout and painting of a network. Sizes are measured bottom-up, from inner to outer groups, then everything is
// painted top-down.
//
// The tree of each pin begins at the left rail and occupies its own lines, below those of the pin above it. The lines
// of a box are together at the top, so the wire of a pin whose tree is lower rises in a column of its own:
//
//   |--[A]--+--------{ADDB 1 D0 1 D1}--+--(Y)
//   |--[B]--+  +-----{ACT           }  +--(S Z)
//   |--[C]-----+
//
// Marks in one column of neighbouring lines join, so a separate line is put between two groups that would touch.
#include "frontend/network/convert/drawing.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "frontend/network/read/canonical.h"
#include "frontend/network/read/drawn_comments.h"
#include "ir/support/check.h"

namespace rung::frontend::network {
namespace {

using Group = SpTree::Kind;

constexpr uint32_t kStart = 3;    // the first column after "|--"
constexpr uint32_t kMaxPad = 100; // longer boxes do not pull their pins along

struct Extent {
  uint32_t width = 0;
  uint32_t height = 1;
  bool marks = false;  // contains a parallel group
  bool onRail = false; // begins at the left rail, which then serves as its left junction
};

struct Spot {
  uint32_t line = 0;
  uint32_t column = 0;
};

class Painter {
public:
  Painter(const Language& language, const Network& network) : language_(language), network_(network) {
    place();
    measure();
  }

  DrawingSize size() const { return {lines_, columns_}; }
  Drawing run();

private:
  struct Tree {
    SpTree sp;
    std::vector<uint32_t> order; // nodes; groups come before their members
    std::vector<Extent> extents;
    uint32_t line = 0;
  };

  void place();
  void measure();
  void measure(Tree& tree) const;
  void measureSeries(Tree& tree, uint32_t node) const;
  void measureParallel(Tree& tree, uint32_t node) const;
  bool separated(const Tree& tree, uint32_t above, uint32_t below) const {
    return tree.extents[above].marks && tree.extents[below].marks;
  }
  std::string boxText() const;

  void put(uint32_t line, uint32_t column, std::string_view text);
  void wire(uint32_t line, uint32_t from, uint32_t to) { put(line, from, std::string(to - from, '-')); }
  void element(uint32_t line, uint32_t column, uint32_t command, std::string_view text);
  void paint(Tree& tree);
  void paintParallel(Tree& tree, uint32_t node, std::vector<Spot>& spots);
  void paintPins();
  void paintBox();
  void paintCoils(uint32_t column, uint32_t joint);

  const Language& language_;
  const Network& network_;
  std::vector<uint32_t> contacts_; // indices of commands
  std::vector<uint32_t> coils_;
  uint32_t function_ = kNone;
  std::vector<std::string> texts_; // per contact
  std::vector<Tree> trees_;        // per pin
  std::string box_;
  uint32_t boxColumn_ = kStart;
  std::vector<uint32_t> risers_; // per pin: the column in which its wire rises; 0 if it does not
  uint64_t lines_ = 0;
  uint64_t columns_ = 0;
  Drawing drawing_;
  std::vector<uint32_t> columnOf_; // per command
};

void Painter::place() {
  for (uint32_t i = 0; i < network_.written.size(); ++i) {
    const Written& command = network_.written[i];
    if (isContact(command.command)) {
      contacts_.push_back(i);
      texts_.push_back(elementText(command.command, command.operand));
    }
    if (isCoil(command.command)) coils_.push_back(i);
    if (command.command == Command::Function) function_ = i;
  }
  auto trees = treesOf(logicOf(network_.written));
  RUNG_CHECK(trees.has_value(), "a network without errors is balanced");
  for (SpTree& tree : *trees) trees_.push_back({.sp = std::move(tree), .order = {}, .extents = {}});
  if (function_ != kNone) box_ = boxText();
}

std::string Painter::boxText() const {
  std::string text = fmt::format("{{{}", network_.function.row->info.mnemonic);
  bool table = false;
  for (const Written& command : network_.written) {
    if (command.command != Command::Parameter && command.command != Command::Table) continue;
    if (command.command == Command::Table && !table) text += fmt::format(" {}", language_.nameOf(Command::Table));
    table = command.command == Command::Table;
    text += fmt::format(" {}", drawnOperand(command.operand));
  }
  return text + '}';
}

void Painter::measureSeries(Tree& tree, uint32_t node) const {
  Extent& extent = tree.extents[node];
  const auto& children = tree.sp.nodes[node].children;
  extent.width = 2 * (static_cast<uint32_t>(children.size()) - 1);
  for (uint32_t child : children) {
    extent.width += tree.extents[child].width;
    extent.height = std::max(extent.height, tree.extents[child].height);
    extent.marks = extent.marks || tree.extents[child].marks;
  }
}

void Painter::measureParallel(Tree& tree, uint32_t node) const {
  Extent& extent = tree.extents[node];
  const auto& children = tree.sp.nodes[node].children;
  extent.marks = true;
  extent.height = 0;
  for (size_t i = 0; i < children.size(); ++i) {
    extent.width = std::max(extent.width, tree.extents[children[i]].width);
    extent.height += tree.extents[children[i]].height;
    if (i > 0 && separated(tree, children[i - 1], children[i])) ++extent.height;
  }
  extent.width += extent.onRail ? 3 : 6;
}

void Painter::measure(Tree& tree) const {
  tree.extents.resize(tree.sp.nodes.size());
  tree.extents[tree.sp.root].onRail = true;
  tree.order.push_back(tree.sp.root);
  for (size_t i = 0; i < tree.order.size(); ++i) {
    const uint32_t node = tree.order[i];
    const SpTree::Node& group = tree.sp.nodes[node];
    for (size_t c = 0; c < group.children.size(); ++c) {
      tree.extents[group.children[c]].onRail = tree.extents[node].onRail && (c == 0 || group.kind == Group::Parallel);
      tree.order.push_back(group.children[c]);
    }
  }
  for (size_t i = tree.order.size(); i-- > 0;) {
    const uint32_t node = tree.order[i];
    switch (tree.sp.nodes[node].kind) {
    case Group::Contact:
      tree.extents[node].width = static_cast<uint32_t>(texts_[tree.sp.nodes[node].contact.index].size());
      break;
    case Group::Series: measureSeries(tree, node); break;
    case Group::Parallel: measureParallel(tree, node); break;
    }
  }
}

void Painter::measure() {
  uint32_t line = 0;
  uint32_t end = kStart;
  uint32_t risers = 0;
  for (size_t pin = 0; pin < trees_.size(); ++pin) {
    Tree& tree = trees_[pin];
    measure(tree);
    const Extent& root = tree.extents[tree.sp.root];
    if (pin > 0 && root.marks && trees_[pin - 1].extents[trees_[pin - 1].sp.root].marks) ++line;
    tree.line = line;
    line += root.height;
    end = std::max(end, kStart + root.width);
    risers_.push_back(tree.line == pin ? 0 : 1);
    risers += risers_.back();
  }
  if (!trees_.empty()) boxColumn_ = end + 2 + 3 * risers;
  uint32_t column = end + 2;
  for (uint32_t& riser : risers_) {
    if (riser == 0) continue;
    riser = column;
    column += 3;
  }
  lines_ = std::max<uint64_t>(line, coils_.size());
  columns_ = boxColumn_ + box_.size();
}

void Painter::put(uint32_t line, uint32_t column, std::string_view text) {
  if (drawing_.lines.size() <= line) {
    drawing_.lines.resize(line + 1);
    drawing_.ends.resize(line + 1);
  }
  std::string& target = drawing_.lines[line];
  if (target.size() < column + text.size()) target.resize(column + text.size(), ' ');
  target.replace(column, text.size(), text);
}

void Painter::element(uint32_t line, uint32_t column, uint32_t command, std::string_view text) {
  put(line, column, text);
  drawing_.lineOf[command] = line;
  columnOf_[command] = column;
  drawing_.ends[line].add(command, [&](uint32_t of) { return columnOf_[of]; });
}

void Painter::paintParallel(Tree& tree, uint32_t node, std::vector<Spot>& spots) {
  const Extent& extent = tree.extents[node];
  const Spot spot = spots[node];
  const uint32_t right = spot.column + extent.width - 1;
  const uint32_t inner = spot.column + (extent.onRail ? 0 : 3);
  const auto& children = tree.sp.nodes[node].children;
  uint32_t line = spot.line;
  for (size_t i = 0; i < children.size(); ++i) {
    if (i > 0) {
      const uint32_t end = line + tree.extents[children[i - 1]].height;
      const uint32_t next = end + (separated(tree, children[i - 1], children[i]) ? 1 : 0);
      for (++line; line < next; ++line) {
        if (!extent.onRail || line == end) put(line, extent.onRail ? 0 : spot.column, "|");
        put(line, right, "|");
      }
    }
    put(line, extent.onRail ? 0 : spot.column, extent.onRail ? "|--" : "+--");
    spots[children[i]] = {line, inner};
    wire(line, inner + tree.extents[children[i]].width, right);
    put(line, right, "+");
  }
}

void Painter::paint(Tree& tree) {
  std::vector<Spot> spots(tree.sp.nodes.size());
  spots[tree.sp.root] = {tree.line, kStart};
  put(tree.line, 0, "|--");
  for (uint32_t node : tree.order) {
    const SpTree::Node& group = tree.sp.nodes[node];
    const Spot spot = spots[node];
    if (group.kind == Group::Contact) {
      element(spot.line, spot.column, contacts_[group.contact.index], texts_[group.contact.index]);
    } else if (group.kind == Group::Parallel) {
      paintParallel(tree, node, spots);
    } else {
      uint32_t column = spot.column;
      for (uint32_t child : group.children) {
        if (column > spot.column) {
          put(spot.line, column, "--");
          column += 2;
        }
        spots[child] = {spot.line, column};
        column += tree.extents[child].width;
      }
    }
  }
}

// Paints the wires between the trees and the box.
void Painter::paintPins() {
  for (uint32_t pin = 0; pin < trees_.size(); ++pin) {
    const Tree& tree = trees_[pin];
    const uint32_t end = kStart + tree.extents[tree.sp.root].width;
    if (risers_[pin] == 0) {
      wire(tree.line, end, boxColumn_);
      continue;
    }
    wire(tree.line, end, risers_[pin]);
    put(tree.line, risers_[pin], "+");
    for (uint32_t line = pin + 1; line < tree.line; ++line) put(line, risers_[pin], "|");
    put(pin, risers_[pin], "+");
    wire(pin, risers_[pin] + 1, boxColumn_);
  }
}

void Painter::paintBox() {
  if (trees_.empty()) put(0, 0, "|--");
  element(0, boxColumn_, function_, box_);
  const auto pins = furtherPinsOf(network_.function.row->info);
  for (uint32_t pin = 1; pin < trees_.size(); ++pin) {
    const size_t width = box_.size() > kMaxPad ? 0 : box_.size() - 2;
    put(pin, boxColumn_, fmt::format("{{{:<{}}", pins[pin - 1].name, width) + '}');
  }
  size_t width = box_.size();
  for (uint32_t pin = 1; pin < std::min(trees_.size(), coils_.size()); ++pin)
    width = std::max(width, pins[pin - 1].name.size() + 2);
  paintCoils(boxColumn_ + static_cast<uint32_t>(box_.size()), boxColumn_ + static_cast<uint32_t>(width) + 2);
}

// From the column after the box or the contacts; several coils from a joint.
void Painter::paintCoils(uint32_t column, uint32_t joint) {
  if (coils_.empty()) return;
  wire(0, column, coils_.size() == 1 ? column + 2 : joint);
  for (uint32_t i = 0; i < coils_.size(); ++i) {
    const Written& coil = network_.written[coils_[i]];
    if (coils_.size() > 1) put(i, joint, "+--");
    element(i, coils_.size() == 1 ? column + 2 : joint + 3, coils_[i], elementText(coil.command, coil.operand));
  }
}

Drawing Painter::run() {
  drawing_.lineOf.assign(network_.written.size(), kNone);
  columnOf_.resize(network_.written.size());
  for (uint32_t line = 0; line < lines_; ++line) put(line, 0, "");
  for (Tree& tree : trees_) paint(tree);
  for (size_t pin = 1; pin < trees_.size(); ++pin) { // the line that separates two trees
    const Tree& above = trees_[pin - 1];
    const uint32_t below = above.line + above.extents[above.sp.root].height;
    if (below < trees_[pin].line) put(below, 0, "|");
  }
  if (function_ != kNone) {
    paintPins();
    paintBox();
  } else {
    const uint32_t end = kStart + trees_[0].extents[trees_[0].sp.root].width;
    paintCoils(end, end + 2);
  }
  return std::move(drawing_);
}

} // namespace

DrawingSize sizeOf(const Language& language, const Network& network) { return Painter(language, network).size(); }
Drawing draw(const Language& language, const Network& network) { return Painter(language, network).run(); }

} // namespace rung::frontend::network
