// Converts networks to cells (see sheet_builder.h).
#include <algorithm>

#include "tools/view/sheet_builder.h"

namespace rung::view {

namespace {

using frontend::Access;
using frontend::chart::Node;
using frontend::chart::NodeKind;

class NetworkDrawing {
public:
  NetworkDrawing(const frontend::chart::Rung& rung, uint32_t file, Names& names, SheetListener& listener)
      : rung_(rung), file_(file), names_(names), listener_(listener) {}

  Sheet run() {
    sheet_.cells.push_back({.kind = Cell::Kind::Rail});
    for (const uint32_t network : rung_.networks) {
      const auto row = static_cast<uint32_t>(sheet_.rows.size());
      sheet_.rows.resize(row + heightOf(network));
      draw(network, row, 0, true);
    }
    if (sheet_.rows.empty()) sheet_.rows.emplace_back();
    findClosing(sheet_);
    return std::move(sheet_);
  }

private:
  uint32_t heightOf(uint32_t node) const;
  uint32_t heightOf(const std::vector<uint32_t>& parts) const;
  // Draws to the right of `column`; returns the column of its last cell.
  uint32_t draw(uint32_t node, uint32_t row, uint32_t column, bool atRail);
  uint32_t drawSeries(const Node& node, uint32_t row, uint32_t column, bool atRail);
  uint32_t drawBranches(const Node& node, uint32_t row, uint32_t column, bool atRail);
  uint32_t drawElement(const Node& node, uint32_t row, uint32_t column, uint32_t inputs);
  void addJoint(const std::vector<uint32_t>& rows, uint32_t column, bool right);
  void stop(uint32_t row, uint32_t cell, bool joined) {
    std::vector<Stop>& stops = sheet_.rows[row].stops;
    stops.push_back({cell, joined && !stops.empty()});
  }
  Operand operandOf(const frontend::chart::Operand& operand, bool coil, uint32_t row);

  const frontend::chart::Rung& rung_;
  const uint32_t file_;
  Names& names_;
  SheetListener& listener_;
  Sheet sheet_;
};

uint32_t NetworkDrawing::heightOf(const std::vector<uint32_t>& parts) const {
  uint32_t rows = 0;
  for (const uint32_t part : parts) rows += heightOf(part);
  return rows;
}

// What leads to further pins of a box in a series is below all that is before the box.
uint32_t NetworkDrawing::heightOf(uint32_t node) const {
  const Node& one = rung_.nodes[node];
  if (one.kind == NodeKind::Parallel || one.kind == NodeKind::Outputs) return heightOf(one.parts);
  if (one.kind != NodeKind::Series) return 1 + heightOf(one.parts);
  uint32_t rows = 1;
  for (const uint32_t part : one.parts) {
    const Node& inner = rung_.nodes[part];
    rows = inner.kind == NodeKind::Box ? rows + heightOf(inner.parts) : std::max(rows, heightOf(part));
  }
  return rows;
}

uint32_t NetworkDrawing::draw(uint32_t node, uint32_t row, uint32_t column, bool atRail) {
  const Node& one = rung_.nodes[node];
  switch (one.kind) {
  case NodeKind::Series: return drawSeries(one, row, column, atRail);
  case NodeKind::Parallel:
  case NodeKind::Outputs: return drawBranches(one, row, column, atRail);
  case NodeKind::Contact:
  case NodeKind::Coil:
  case NodeKind::Box: break;
  }
  if (atRail) stop(row, 0, false);
  return drawElement(one, row, column, row + 1);
}

uint32_t NetworkDrawing::drawSeries(const Node& node, uint32_t row, uint32_t column, bool atRail) {
  uint32_t below = row + 1; // the first row that is free at the rail
  bool first = atRail;
  for (const uint32_t part : node.parts) {
    const Node& one = rung_.nodes[part];
    if (one.kind == NodeKind::Box && !first) {
      column = drawElement(one, row, column, below);
      below += heightOf(one.parts);
    } else {
      column = draw(part, row, column, first);
      below = std::max(below, row + heightOf(part));
    }
    first = false;
  }
  return column;
}

void NetworkDrawing::addJoint(const std::vector<uint32_t>& rows, uint32_t column, bool right) {
  const auto cell = static_cast<uint32_t>(sheet_.cells.size());
  sheet_.cells.push_back(
      {.kind = Cell::Kind::Joint, .column = column, .firstRow = rows.front(), .lastRow = rows.back()});
  for (uint32_t row = rows.front(); row <= rows.back(); ++row)
    stop(row, cell, right ? std::ranges::find(rows, row) != rows.end() : row == rows.front());
}

uint32_t NetworkDrawing::drawBranches(const Node& node, uint32_t row, uint32_t column, bool atRail) {
  std::vector<uint32_t> rows;
  for (uint32_t next = row; const uint32_t part : node.parts) {
    rows.push_back(next);
    next += heightOf(part);
  }
  if (!atRail) addJoint(rows, ++column, false);
  uint32_t last = column;
  for (size_t i = 0; i < rows.size(); ++i) last = std::max(last, draw(node.parts[i], rows[i], column, atRail));
  if (node.kind == NodeKind::Parallel) addJoint(rows, ++last, true);
  return last;
}

Operand NetworkDrawing::operandOf(const frontend::chart::Operand& operand, bool coil, uint32_t row) {
  const Named named = names_.find(operand);
  Operand made{operand.label, operand.text, named.address, named.comment, {}};
  if (!operand.target.scope.empty()) {
    made.link = listener_.onTarget(operand.target, row);
    return made;
  }
  const Access access = operand.use.access;
  const bool isPlace = operand.use.place.bits != 0;
  if (coil || (isPlace && isWritten(access)))
    made.link = listener_.onUse({.named = named, .operand = operand.text, .writes = true, .coil = coil, .row = row});
  if (!coil && access != Access::Write)
    made.link = listener_.onUse({.named = named, .operand = operand.text, .row = row});
  return made;
}

// `inputs`: the row of what leads to the second pin.
uint32_t NetworkDrawing::drawElement(const Node& node, uint32_t row, uint32_t column, uint32_t inputs) {
  uint32_t end = column;
  std::vector<uint32_t> pins{row};
  for (const uint32_t part : node.parts) {
    pins.push_back(inputs);
    end = std::max(end, draw(part, inputs, 0, true));
    inputs += heightOf(part);
  }
  Cell cell{.column = end + 1, .firstRow = row, .lastRow = pins.back(), .mark = node.mark, .title = node.title};
  cell.place = {file_, node.line, node.column};
  cell.kind = node.kind == NodeKind::Box    ? Cell::Kind::Box
              : node.kind == NodeKind::Coil ? Cell::Kind::Coil
                                            : Cell::Kind::Contact;
  const auto index = static_cast<uint32_t>(sheet_.cells.size());
  for (uint32_t r = row; r <= pins.back(); ++r) {
    stop(r, index, std::ranges::find(pins, r) != pins.end());
    if (node.kind == NodeKind::Box) cell.pins.emplace_back();
  }
  const bool isBox = node.kind == NodeKind::Box;
  const bool isPlace = !node.operands.empty() && node.operands[0].use.place.bits != 0;
  for (const frontend::chart::Operand& operand : node.operands) {
    Operand made = operandOf(operand, node.kind == NodeKind::Coil && isPlace, row);
    if (isBox)
      cell.operands.push_back(std::move(made));
    else
      cell.operand = std::move(made);
  }
  if (!node.comment.empty()) {
    std::string& remark = sheet_.rows[row].remark;
    remark.append(remark.empty() ? "" : "; ").append(node.comment);
  }
  sheet_.cells.push_back(std::move(cell));
  return end + 1;
}

} // namespace

Sheet buildSheet(const frontend::chart::Rung& rung, uint32_t file, Names& names, SheetListener& listener) {
  return NetworkDrawing(rung, file, names, listener).run();
}

} // namespace rung::view
