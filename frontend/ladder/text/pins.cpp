// Which boxes are the pin lines of the box above them.
#include <algorithm>

#include "frontend/ladder/text/drawing.h"
#include "ir/support/diag/ladder.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::ladder {
namespace {

/// A box and its pin lines so far.
struct Group {
  uint32_t head = kNone;
  uint32_t lastPin = kNone;
  uint32_t pinLines = 0;
  std::optional<std::span<const frontend::PinInfo>> pins; ///< its further ones; nothing where they are not known

  bool lacksPins() const { return pins && pinLines < pins->size(); }
};

/// A line of a group: where its braces are.
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
  std::vector<Row> above_; ///< by column
  std::vector<Row> here_;
};

bool PinGrouper::isNamed(const Group& group, std::string_view word) const {
  return group.pins && std::ranges::any_of(*group.pins, [&](const frontend::PinInfo& pin) {
           return text::equalsIgnoringCase(pin.name, word);
         });
}

/// Below a box that still lacks pins a wrong name is an unknown pin, not another box.
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

/// The row above, left or right of this column, that the box was probably meant for: the word names a pin that is still
/// missing there or, where the names are not known, it is padded like a pin line and is over the other box.
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
      // Continue as if it were where it should be, so that the lines below are judged by the box.
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

} // namespace rung::frontend::ladder
