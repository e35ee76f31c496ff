// Converts tokens to cells (see sheet_builder.h).
#include "tools/view/sheet_builder.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "rtlib/text/letters.h"

namespace rung::view {

using frontend::ladder::Comment;
using frontend::ladder::Drawing;
using frontend::ladder::Element;
using frontend::ladder::ElementKind;
using frontend::ladder::kNone;
using frontend::ladder::Token;
using frontend::ladder::TokenKind;

namespace {

// GSK's word before the values of a table, in upper or lower case.
bool isTableWord(std::string_view text) { return text::equalsIgnoringCase(text, "TABLE"); }

// The letters in a contact or coil.
std::string markOf(const Element& element, std::string_view operand) {
  std::string mark;
  if (element.kind == ElementKind::Coil && element.coil == frontend::ladder::CoilKind::Set) mark = "S";
  if (element.kind == ElementKind::Coil && element.coil == frontend::ladder::CoilKind::Reset) mark = "R";
  if (element.negated || (element.kind == ElementKind::Coil && element.coil == frontend::ladder::CoilKind::Negated))
    mark = "/";
  if (element.edge == '@') mark += 'P';
  if (element.edge == '%') mark += 'N';
  if (operand.starts_with('!')) mark += 'I';
  return mark;
}

} // namespace

// A rung that is being converted.
class SheetDrawing {
public:
  SheetDrawing(const SheetContext& context, const Drawing& drawing, SheetListener& listener)
      : context_(context), drawing_(drawing), listener_(listener) {}

  Sheet run() {
    sheet_.cells.push_back({.kind = Cell::Kind::Rail});
    joinMarks();
    cellOf_.assign(drawing_.elements.size(), kNone);
    for (uint32_t line = 0; line < drawing_.lines.size(); ++line) addRow(line);
    findClosing(sheet_);
    return std::move(sheet_);
  }

private:
  // A `+` or `|`, with the joint that contains it.
  struct Mark {
    uint32_t column = 0;
    uint32_t joint = 0;
  };
  struct Joint {
    uint32_t firstRow = 0;
    uint32_t lastRow = 0;
    uint32_t cell = kNone;
  };

  void joinMarks();
  void addMark(uint32_t line, uint32_t column, const std::vector<Mark>& above, size_t& at, std::vector<Mark>& here);
  void addRow(uint32_t line);
  void addStop(Row& row, uint32_t cell, bool joined) { row.stops.push_back({cell, joined && !row.stops.empty()}); }
  uint32_t jointCell(const Mark& mark);
  uint32_t elementCell(uint32_t element, uint32_t line);
  void addContact(Cell& cell, const Element& element);
  void addBox(Cell& cell, const Element& element);
  Operand operandOf(const frontend::Word& word, const frontend::OperandInfo* info, uint32_t row);
  std::string remarkOf(uint32_t line) const;
  std::string_view messageOf(const std::string& number) const {
    const auto at = context_.texts.find(number);
    return at == context_.texts.end() ? std::string_view() : at->second;
  }

  const SheetContext& context_;
  const Drawing& drawing_;
  SheetListener& listener_;
  Sheet sheet_;
  std::vector<std::vector<Mark>> marks_; // by line
  std::vector<Joint> joints_;
  std::vector<uint32_t> cellOf_; // by element
};

void SheetDrawing::addMark(uint32_t line, uint32_t column, const std::vector<Mark>& above, size_t& at,
                           std::vector<Mark>& here) {
  while (at < above.size() && above[at].column < column) ++at;
  if (at < above.size() && above[at].column == column) {
    here.push_back(above[at]);
    joints_[above[at].joint].lastRow = line;
    return;
  }
  here.push_back({column, static_cast<uint32_t>(joints_.size())});
  joints_.push_back({line, line, kNone});
}

// Marks in one column of neighbouring lines form a joint; those in column 0 are the rail.
void SheetDrawing::joinMarks() {
  static const std::vector<Mark> kNothing;
  for (uint32_t line = 0; line < drawing_.lines.size(); ++line) {
    const std::vector<Mark>& above = line == 0 ? kNothing : marks_[line - 1];
    std::vector<Mark> here;
    size_t at = 0;
    for (const Token& token : drawing_.tokensOf(drawing_.lines[line])) {
      if (token.kind == TokenKind::Element) continue;
      for (uint32_t i = token.begin; i < token.end; ++i)
        if (drawing_.lines[line].source.text[i] != '-') addMark(line, token.column + i - token.begin, above, at, here);
    }
    marks_.push_back(std::move(here));
  }
}

// kNone for a `+` that is only part of a wire.
uint32_t SheetDrawing::jointCell(const Mark& mark) {
  if (mark.column == 0) return 0;
  Joint& joint = joints_[mark.joint];
  if (joint.firstRow == joint.lastRow) return kNone;
  if (joint.cell == kNone) {
    joint.cell = static_cast<uint32_t>(sheet_.cells.size());
    sheet_.cells.push_back(
        {.kind = Cell::Kind::Joint, .column = mark.column, .firstRow = joint.firstRow, .lastRow = joint.lastRow});
  }
  return joint.cell;
}

void SheetDrawing::addRow(uint32_t line) {
  Row row;
  size_t mark = 0;
  bool joined = false;
  uint32_t end = kNone; // end of the token to the left
  for (const Token& token : drawing_.tokensOf(drawing_.lines[line])) {
    joined = joined && token.begin == end;
    end = token.end;
    if (token.kind == TokenKind::Element) {
      addStop(row, elementCell(token.element, line), joined);
      joined = true;
      continue;
    }
    for (uint32_t i = token.begin; i < token.end; ++i) {
      if (drawing_.lines[line].source.text[i] == '-') continue;
      const uint32_t cell = jointCell(marks_[line][mark++]);
      if (cell == kNone) continue;
      addStop(row, cell, joined);
      joined = true;
    }
    if (token.kind == TokenKind::Bar) joined = false;
  }
  row.remark = remarkOf(line);
  sheet_.rows.push_back(std::move(row));
}

// The comment after the line.
std::string SheetDrawing::remarkOf(uint32_t line) const {
  const uint32_t number = drawing_.lines[line].source.number;
  const auto at = std::ranges::lower_bound(drawing_.comments, number, {}, &Comment::line);
  return at == drawing_.comments.end() || at->line != number ? std::string() : std::string(at->text);
}

uint32_t SheetDrawing::elementCell(uint32_t element, uint32_t line) {
  const uint32_t head = drawing_.headOf[element];
  const Element& drawn = drawing_.elements[element];
  if (head != kNone) {
    Cell& box = sheet_.cells[cellOf_[head]];
    box.lastRow = line;
    box.pins.emplace_back(drawn.mnemonic);
    return cellOf_[head];
  }
  cellOf_[element] = static_cast<uint32_t>(sheet_.cells.size());
  Cell cell{.column = drawn.column - 1, .firstRow = line, .lastRow = line};
  cell.place = context_.placeOf(drawn.range.begin);
  if (drawn.kind == ElementKind::Box)
    addBox(cell, drawn);
  else
    addContact(cell, drawn);
  sheet_.cells.push_back(std::move(cell));
  return cellOf_[element];
}

void SheetDrawing::addContact(Cell& cell, const Element& element) {
  const frontend::Word& word = drawing_.operands[element.operands.first];
  const bool coil = element.kind == ElementKind::Coil;
  const Named named = context_.names.find(word);
  cell.kind = coil ? Cell::Kind::Coil : Cell::Kind::Contact;
  cell.mark = markOf(element, word.text);
  cell.operand = {{}, std::string(word.text), named.address, named.comment, {}};
  if (coil) {
    const std::string_view message = messageOf(named.key);
    if (!message.empty()) cell.operand.note += fmt::format("{}“{}”", named.comment.empty() ? "" : " ", message);
  }
  cell.operand.link =
      listener_.onUse({.named = named, .operand = word.text, .writes = coil, .coil = coil, .row = cell.firstRow});
}

Operand SheetDrawing::operandOf(const frontend::Word& word, const frontend::OperandInfo* info, uint32_t row) {
  using frontend::Access;
  Operand operand{info == nullptr ? "" : std::string(info->name), std::string(word.text), {}, {}, {}};
  if (word.quoted) {
    operand.name = fmt::format("\"{}\"", word.text);
    return operand;
  }
  const Named named = context_.names.find(word);
  operand.address = named.address;
  operand.note = named.comment;
  if (info == nullptr) return operand;
  const bool message = info->name == "Message Number";
  if (message) {
    std::string_view number = context_.names.valueOf(word);
    number.remove_prefix(number.starts_with('#') ? 1 : 0);
    const std::string_view text = messageOf(std::string(number));
    if (!text.empty()) operand.note = fmt::format("“{}”", text);
    operand.link = listener_.onUse({.named = {{}, {}, messageKey(number)}, .operand = word.text, .row = row});
  }
  Link link;
  if (isWritten(info->access))
    link = listener_.onUse({.named = named, .operand = word.text, .writes = true, .row = row});
  if (info->access != Access::Write) link = listener_.onUse({.named = named, .operand = word.text, .row = row});
  if (!message) operand.link = link;
  return operand;
}

void SheetDrawing::addBox(Cell& cell, const Element& element) {
  const frontend::InstructionInfo* info = context_.findBox(element.mnemonic);
  cell.kind = Cell::Kind::Box;
  cell.title = element.mnemonic;
  cell.pins.emplace_back(info == nullptr || info->pins.size() == 0 ? "" : info->pins[0].name);
  const size_t known = info == nullptr ? 0 : info->operands.size();
  size_t place = 0;
  bool table = false;
  for (uint32_t i = 0; i < element.operands.count; ++i) {
    const frontend::Word& word = drawing_.operands[element.operands.first + i];
    if (context_.hasTables && isTableWord(word.text)) {
      table = true;
      cell.operands.push_back({"table", "", "", "", {}});
      continue;
    }
    const bool more = place >= known && known > 0 && info->operands[known - 1].repeated;
    const frontend::OperandInfo* of = place < known ? &info->operands[place]
                                      : more        ? &info->operands[known - 1]
                                                    : nullptr;
    Operand operand = operandOf(word, table ? nullptr : of, cell.firstRow);
    ++place;
    const frontend::TargetUse* asked = context_.names.targetAt(word);
    const Link target = asked == nullptr ? Link{} : listener_.onTarget(*asked, cell.firstRow);
    if (target.to != Link::To::Nothing) cell.link = operand.link = target;
    // Values of a table are put on one line.
    if (table && operand.address.empty() && cell.operands.back().name.size() < 28 &&
        cell.operands.back().address.empty()) {
      std::string& line = cell.operands.back().name;
      line.append(line.empty() ? "" : " ").append(operand.name);
    } else {
      cell.operands.push_back(std::move(operand));
    }
  }
}

void findClosing(Sheet& sheet) {
  std::vector<uint32_t> lastIn(sheet.cells.size(), 0);
  for (const Row& row : sheet.rows)
    if (!row.stops.empty()) ++lastIn[row.stops.back().cell];
  for (uint32_t i = 0; i < sheet.cells.size(); ++i) {
    Cell& cell = sheet.cells[i];
    const bool closes = cell.kind == Cell::Kind::Coil || cell.kind == Cell::Kind::Box;
    cell.closing = closes && lastIn[i] == cell.lastRow - cell.firstRow + 1;
  }
}

std::string messageKey(std::string_view number) { return fmt::format("message {}", number); }

Sheet buildSheet(const SheetContext& context, const Drawing& drawing, SheetListener& listener) {
  return SheetDrawing(context, drawing, listener).run();
}

} // namespace rung::view
