// Lays out a rung: measures, places from left to right, places from top to bottom, draws.
#include "tools/view/layout.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string_view>

namespace rung::view {
namespace {

using Kind = Cell::Kind;

constexpr int kCellWidth = 96;  // minimum for a contact
constexpr int kCoilWidth = 128; // so that coils are aligned
constexpr int kGrid = 16;
constexpr int kNoteWidth = 112;  // of the comment at a contact
constexpr size_t kManyLines = 3; // most lines of a comment; beyond them it becomes wider
constexpr int kWideNote = 160;
constexpr int kSide = 14; // between the texts of neighbours
constexpr int kPad = 8;   // within boxes
constexpr int kHead = 20; // height of the bar of a box
constexpr int kBoxNoteWidth = 230;
constexpr int kAlignedBox = 400; // wider boxes are not aligned with others
constexpr int kRowGap = 8;
constexpr int kRemarkGap = 14;
constexpr int kTop = 2;
constexpr int kBare = 2; // half the height of a row with vertical wires only
constexpr int kBandGap = 14;
constexpr int kHalo = 4;
constexpr int kEnd = 16; // between the end of a branch and the right rail

constexpr Style kLabel = Style::Label;

// The size of a cell before it is placed.
struct Measure {
  int width = 0;
  int symbol = 0; // width of the contact or coil without texts
  int above = 0;  // height above the wire in its first row
  int below = 0;
  int labels = 0; // boxes: width of the columns
  int pins = 0;
  int body = 0; // boxes: height below the bar
  std::vector<std::string> note;
  std::vector<std::vector<std::string>> notes; // by operand
};

struct Height {
  int above = 0;
  int below = 0;
};

// A row in one of the bands that contain a part of it.
struct BandRow {
  uint32_t band = 0;
  uint32_t firstStop = 0; // index of the first stop in the band
  uint32_t stopsEnd = 0;
  int wire = 0; // y
};

// Only places have values that change.
bool hasValue(const Operand& operand) { return operand.link.to == Link::To::Name; }

int addressWidth(const Operand& operand) {
  return operand.address.empty() ? 0 : kPad + widthOf(operand.address, Style::Address);
}

int roundUp(int value, int step) { return (value + step - 1) / step * step; }

int noteWidth(const std::vector<std::string>& lines, Style style) {
  int width = 0;
  for (const std::string& line : lines) width = std::max(width, widthOf(line, style));
  return width;
}

// "read in 3, 10 and 4 more".
std::vector<LinkedText> wordsOf(const CrossReference& reference) {
  std::vector<LinkedText> words;
  const auto word = [&]() -> LinkedText& { return words.emplace_back(); };
  for (size_t at = 0; at < reference.lead.size();) {
    const size_t end = std::min(reference.lead.find(' ', at), reference.lead.size());
    word().add(reference.lead.substr(at, end - at));
    at = end + 1;
  }
  for (size_t i = 0; i < reference.rungs.size(); ++i) {
    LinkedText& number = word();
    number.add(std::to_string(reference.rungs[i]), {Link::To::Rung, reference.rungs[i]});
    if (i + 1 < reference.rungs.size()) number.add(",");
  }
  if (reference.further > 0) {
    word().add("and");
    word().add(std::to_string(reference.further) + " more", reference.all);
  }
  return words;
}

// Text below a contact or coil: its address, and the rungs that write it.
LinkedText underline(const Cell& cell) {
  LinkedText line;
  line.add(cell.operand.address);
  if (cell.writers.rungs.empty()) return line;
  if (!line.text.empty()) line.add(" ");
  line.add(cell.writers.lead);
  for (size_t i = 0; i < cell.writers.rungs.size(); ++i) {
    if (i > 0) line.add(",");
    line.add(std::to_string(cell.writers.rungs[i]), {Link::To::Rung, cell.writers.rungs[i]});
  }
  if (cell.writers.further > 0) line.add("+" + std::to_string(cell.writers.further), cell.writers.all);
  return line;
}

class Layout {
public:
  Layout(const Sheet& sheet, int valueSpace)
      : sheet_(sheet), valueSpace_(valueSpace), left_(sheet.cells.size()), bands_(sheet.cells.size()) {
    for (const Cell& cell : sheet.cells) measures_.push_back(measure(cell));
    alignBoxes();
    placeColumns();
  }

  int rail() const { return rail_; }
  Picture run(int rail);

private:
  Measure measure(const Cell& cell) const;
  Measure measureSymbol(const Cell& cell) const;
  Measure measureBox(const Cell& cell) const;
  bool isClosingBox(size_t cell) const { return sheet_.cells[cell].closing && sheet_.cells[cell].kind == Kind::Box; }
  int gap(const Cell& left, const Cell& right) const;
  void alignBoxes();
  void placeColumns();
  void cut(int rail);
  std::vector<int> widths() const;
  void alignRight();
  void placeRows();
  void addBandRows(uint32_t row);
  Height rowHeight(uint32_t row, uint32_t band, int wire) const;
  int boxBelow(uint32_t cell, uint32_t row, int wire) const;
  size_t bandIndex(uint32_t row, uint32_t band) const;
  int wireIn(uint32_t band, uint32_t row) const { return rows_[row][bandIndex(row, band)].wire; }
  int wireOf(uint32_t cell, uint32_t row) const { return wireIn(bands_[cell], row); }

  void draw();
  void drawRow(uint32_t row);
  void drawWire(uint32_t row, uint32_t left, uint32_t right);
  void drawRemark(uint32_t row);
  void drawJoint(uint32_t cell);
  void drawSymbol(uint32_t cell);
  void drawBox(uint32_t cell);
  struct OperandPlace {
    uint32_t cell = 0, operand = 0; // operand: index
    int label = 0, value = 0, y = 0;
  };
  int drawOperand(const OperandPlace& place, const std::vector<std::string>& note);
  void halo(const Cell& cell, Point corner, int width, int height);
  void text(int x, int y, Anchor anchor, Style style, std::string_view text, Link link = {});
  void text(int x, int y, Anchor anchor, Style style, LinkedText text);

  int leftPort(uint32_t cell) const;
  int rightPort(uint32_t cell) const;
  std::vector<std::string> remarkLines(const Row& row) const { return wrap(row.remark, Style::Remark, kMargin - 20); }
  std::vector<LinkedText> useLines(const Row& row) const;

  const Sheet& sheet_;
  const int valueSpace_;
  std::vector<Measure> measures_;
  std::vector<int> left_;       // by cell
  std::vector<uint32_t> bands_; // by cell
  uint32_t bandCount_ = 1;
  std::vector<std::vector<BandRow>> rows_; // by row, its bands from left to right
  int rail_ = 0;
  std::vector<bool> inBox_; // by row: whether a box continues from the row above
  int y_ = kTop;
  int jumps_ = 0;
  Picture picture_;
};

Measure Layout::measureSymbol(const Cell& cell) const {
  Measure m;
  const bool letters = cell.mark.size() > 1 || (cell.mark.size() == 1 && cell.mark != "/");
  m.symbol = cell.kind == Kind::Coil ? 24 : 18;
  if (letters) m.symbol = std::max(m.symbol, widthOf(cell.mark, Style::Mark) + (cell.kind == Kind::Coil ? 14 : 8));
  const int name = widthOf(cell.operand.name, Style::Name);
  m.note = wrap(cell.operand.note, Style::Note, std::max(kNoteWidth, name));
  if (m.note.size() > kManyLines) m.note = wrap(cell.operand.note, Style::Note, std::max(kWideNote, name));
  const LinkedText under = underline(cell);
  const int texts = std::max({name, widthOf(under.text, Style::Address), noteWidth(m.note, Style::Note), m.symbol + 12,
                              widthOf(cell.badge, Style::Badge)});
  const int least = cell.kind == Kind::Coil ? kCoilWidth : kCellWidth;
  m.width = std::max(least, roundUp(texts + kSide, kGrid));
  m.above = kSymbolHalf + 5 + lineHeight(Style::Name) + static_cast<int>(m.note.size()) * lineHeight(Style::Note);
  m.below = kSymbolHalf + 4 + (under.text.empty() ? 0 : lineHeight(Style::Address)) +
            (cell.badge.empty() ? 0 : lineHeight(Style::Badge));
  return m;
}

Measure Layout::measureBox(const Cell& cell) const {
  Measure m;
  for (const std::string& pin : cell.pins) m.pins = std::max(m.pins, widthOf(pin, Style::Pin));
  if (m.pins > 0) m.pins += kPad;
  int values = 0;
  for (const Operand& operand : cell.operands) {
    m.labels = std::max(m.labels, widthOf(operand.label, kLabel) + (operand.label.empty() ? 0 : kPad));
    const int after = addressWidth(operand) + (hasValue(operand) ? valueSpace_ : 0);
    m.notes.push_back(wrap(operand.note, Style::Note, kBoxNoteWidth));
    values = std::max({values, widthOf(operand.name, Style::Name) + after, noteWidth(m.notes.back(), Style::Note)});
    m.body += lineHeight(Style::Name) + 2 + static_cast<int>(m.notes.back().size()) * lineHeight(Style::Note);
  }
  m.body += kPad + (cell.badge.empty() ? 0 : lineHeight(Style::Badge));
  values = std::max(values, widthOf(cell.badge, Style::Badge));
  const int body = kPad + m.pins + m.labels + values + kPad;
  m.width = roundUp(std::max({64, widthOf(cell.title, Style::Title) + 2 * kPad, body}), kGrid);
  m.above = kHead + 14;
  return m;
}

Measure Layout::measure(const Cell& cell) const {
  switch (cell.kind) {
  case Kind::Rail:
  case Kind::Joint: return {};
  case Kind::Contact:
  case Kind::Coil: return measureSymbol(cell);
  case Kind::Box: return measureBox(cell);
  }
  return {};
}

std::vector<LinkedText> Layout::useLines(const Row& row) const {
  std::vector<LinkedText> lines;
  for (const CrossReference& reference : row.uses)
    for (LinkedText& line : wrap(wordsOf(reference), Style::Uses, kMargin - 20)) lines.push_back(std::move(line));
  return lines;
}

// Contacts and coils include their own wires.
int Layout::gap(const Cell& left, const Cell& right) const {
  const auto narrow = [](const Cell& cell) { return cell.kind == Kind::Joint || cell.kind == Kind::Rail; };
  if (narrow(left) && narrow(right)) return 24;
  if (left.kind == Kind::Box && right.kind == Kind::Box) return 32;
  if (left.kind == Kind::Box || right.kind == Kind::Box) return 16;
  return narrow(left) || narrow(right) ? 4 : 0;
}

// Boxes at the right rail get the width of the widest one, so that their left sides are aligned.
void Layout::alignBoxes() {
  int widest = 0;
  for (size_t i = 0; i < measures_.size(); ++i)
    if (isClosingBox(i) && measures_[i].width <= kAlignedBox) widest = std::max(widest, measures_[i].width);
  for (size_t i = 0; i < measures_.size(); ++i)
    if (isClosingBox(i)) measures_[i].width = std::max(measures_[i].width, widest);
}

// Places every cell as far to the left as the cells before it in its rows allow.
void Layout::placeColumns() {
  std::vector<uint32_t> order(sheet_.cells.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return sheet_.cells[a].column < sheet_.cells[b].column; });
  std::vector<uint32_t> last(sheet_.rows.size(), 0); // by row: the cell to the left
  left_[0] = kLeft;
  for (uint32_t cell : order) {
    const Cell& here = sheet_.cells[cell];
    if (cell == 0) continue;
    for (uint32_t row = here.firstRow; row <= here.lastRow; ++row) {
      const uint32_t before = last[row];
      const int end = left_[before] + measures_[before].width + gap(sheet_.cells[before], here);
      left_[cell] = std::max(left_[cell], end);
      last[row] = cell;
    }
    rail_ = std::max(rail_, left_[cell] + measures_[cell].width + (here.kind == Kind::Coil ? 0 : kEnd));
  }
  rail_ = roundUp(rail_, kGrid);
}

std::vector<int> Layout::widths() const {
  std::vector<int> result;
  result.reserve(measures_.size());
  for (const Measure& m : measures_) result.push_back(m.width);
  return result;
}

// Cuts a rung that is too wide, from left to right.
void Layout::cut(int rail) {
  if (rail_ <= rail) {
    rail_ = rail;
    return;
  }
  const Cuts cuts = chooseCuts(sheet_, left_, widths(), rail_, rail);
  int needed = rail;
  for (size_t i = 0; i < cuts.size(); ++i)
    needed = std::max(needed, cuts[i] - (i == 0 ? 0 : cuts[i - 1] - kBandStart) + kBandEnd);
  for (uint32_t cell = 1; cell < left_.size(); ++cell) {
    const auto at = std::upper_bound(cuts.begin(), cuts.end(), left_[cell]);
    bands_[cell] = static_cast<uint32_t>(at - cuts.begin());
    if (bands_[cell] > 0) left_[cell] += kBandStart - cuts[bands_[cell] - 1];
    const bool coil = sheet_.cells[cell].kind == Kind::Coil;
    needed = std::max(needed, left_[cell] + measures_[cell].width + (coil ? 0 : kEnd));
  }
  bandCount_ = static_cast<uint32_t>(cuts.size() + 1);
  rail_ = roundUp(needed, kGrid);
}

void Layout::alignRight() {
  for (uint32_t cell = 0; cell < sheet_.cells.size(); ++cell) {
    const Cell& here = sheet_.cells[cell];
    if (here.closing) left_[cell] = rail_ - measures_[cell].width - (here.kind == Kind::Coil ? 0 : kEnd);
  }
}

size_t Layout::bandIndex(uint32_t row, uint32_t band) const {
  const std::vector<BandRow>& bands = rows_[row];
  const auto at = std::lower_bound(bands.begin(), bands.end(), band,
                                   [](const BandRow& one, uint32_t wanted) { return one.band < wanted; });
  return static_cast<size_t>(at - bands.begin());
}

// Adds the bands in which the row has stops or wires.
void Layout::addBandRows(uint32_t row) {
  std::vector<BandRow>& bands = rows_.emplace_back();
  const std::vector<Stop>& stops = sheet_.rows[row].stops;
  for (uint32_t i = 0; i < stops.size(); ++i) {
    const uint32_t band = bands_[stops[i].cell];
    const bool wired = stops[i].joined; // then i > 0
    for (uint32_t k = wired ? bands_[stops[i - 1].cell] + 1 : band; k < band; ++k) bands.push_back({k, i, i, 0});
    if (bands.empty() || bands.back().band != band) bands.push_back({band, i, i, 0});
    bands.back().stopsEnd = i + 1;
  }
}

// Height of a box below the wire of its last row.
int Layout::boxBelow(uint32_t cell, uint32_t row, int wire) const {
  const Cell& box = sheet_.cells[cell];
  const int done = row == box.firstRow ? 0 : wire - wireOf(cell, box.firstRow);
  return measures_[cell].body + kHead - measures_[cell].above - done;
}

// `wire` matters for the height below only.
Height Layout::rowHeight(uint32_t row, uint32_t band, int wire) const {
  Height height{kBare, kBare};
  const BandRow& part = rows_[row][bandIndex(row, band)];
  for (uint32_t i = part.firstStop; i < part.stopsEnd; ++i) {
    const Stop& stop = sheet_.rows[row].stops[i];
    const Cell& cell = sheet_.cells[stop.cell];
    const Measure& m = measures_[stop.cell];
    const bool solid = stop.joined || (cell.kind != Kind::Joint && cell.kind != Kind::Rail);
    height.above = std::max({height.above, solid ? kSymbolHalf : 0, cell.firstRow == row ? m.above : 0});
    height.below = std::max({height.below, solid ? kSymbolHalf : 0, m.below});
    if (cell.kind == Kind::Box && cell.lastRow == row)
      height.below = std::max(height.below, boxBelow(stop.cell, row, wire));
  }
  if (rows_[row].back().band != band) return height;
  const int remark = static_cast<int>(remarkLines(sheet_.rows[row]).size()) * lineHeight(Style::Remark) +
                     static_cast<int>(useLines(sheet_.rows[row]).size()) * lineHeight(Style::Uses);
  height.above = std::max(height.above, remark > 0 ? kSymbolHalf : 0);
  height.below = std::max(height.below, remark);
  return height;
}

// The wire of a row is placed before the height below it is known, which depends on where the boxes that end there
// begin.
void Layout::placeRows() {
  std::vector<std::vector<uint32_t>> rowsOf(bandCount_);
  inBox_.assign(sheet_.rows.size(), false);
  for (const Cell& cell : sheet_.cells)
    if (cell.kind == Kind::Box) std::fill_n(inBox_.begin() + cell.firstRow + 1, cell.lastRow - cell.firstRow, true);
  for (uint32_t row = 0; row < sheet_.rows.size(); ++row) {
    addBandRows(row);
    for (const BandRow& part : rows_[row]) rowsOf[part.band].push_back(row);
  }
  for (uint32_t band = 0; band < bandCount_; ++band) {
    if (band > 0) y_ += kBandGap;
    for (uint32_t row : rowsOf[band]) {
      if (y_ > kTop && !inBox_[row]) picture_.breaks.push_back(y_ - kRowGap / 2);
      const int wire = y_ + rowHeight(row, band, 0).above;
      rows_[row][bandIndex(row, band)].wire = wire;
      y_ = wire + rowHeight(row, band, wire).below + kRowGap;
    }
  }
  picture_.height = y_;
}

int Layout::leftPort(uint32_t cell) const {
  const Measure& m = measures_[cell];
  return m.symbol == 0 ? left_[cell] : left_[cell] + (m.width - m.symbol) / 2;
}

int Layout::rightPort(uint32_t cell) const {
  const Measure& m = measures_[cell];
  return m.symbol == 0 ? left_[cell] + m.width : leftPort(cell) + m.symbol;
}

void Layout::text(int x, int y, Anchor anchor, Style style, std::string_view text, Link link) {
  LinkedText whole;
  whole.add(text, link);
  this->text(x, y, anchor, style, std::move(whole));
}

void Layout::text(int x, int y, Anchor anchor, Style style, LinkedText text) {
  if (!text.text.empty())
    picture_.texts.push_back({{x, y}, anchor, style, std::move(text.text), std::move(text.links)});
}

// Draws from cell to cell, across the ends of bands.
void Layout::drawWire(uint32_t row, uint32_t left, uint32_t right) {
  int x = rightPort(left);
  for (uint32_t band = bands_[left]; band < bands_[right]; ++band) {
    const Point end{rail_ - kBandEnd, wireIn(band, row)};
    const Point start{kBandWire, wireIn(band + 1, row)};
    const std::string number = std::to_string(++jumps_);
    picture_.wires.push_back({{x, end.y}, end, left});
    picture_.jumps.push_back({end, start});
    text(end.x + 3, end.y + 4, Anchor::Start, Style::Pin, "\u2192" + number);
    text(start.x - 3, start.y + 4, Anchor::End, Style::Pin, number + "\u2192");
    x = start.x;
  }
  const int y = wireOf(right, row);
  picture_.wires.push_back({{x, y}, {leftPort(right), y}, left});
}

void Layout::drawRow(uint32_t row) {
  const std::vector<Stop>& stops = sheet_.rows[row].stops;
  for (size_t i = 0; i < stops.size(); ++i) {
    const Cell& cell = sheet_.cells[stops[i].cell];
    const int y = wireOf(stops[i].cell, row);
    if (stops[i].joined) drawWire(row, stops[i - 1].cell, stops[i].cell);
    if (cell.closing && cell.firstRow == row)
      picture_.wires.push_back({{rightPort(stops[i].cell), y}, {rail_, y}, stops[i].cell});
    if (cell.kind != Kind::Joint) continue;
    const bool right = i + 1 < stops.size() && stops[i + 1].joined;
    const int ways = stops[i].joined + right + (row > cell.firstRow) + (row < cell.lastRow);
    if (ways > 2) picture_.dots.push_back({left_[stops[i].cell], y});
  }
}

void Layout::drawRemark(uint32_t row) {
  if (rows_[row].empty()) return;
  const int x = rail_ + kRemarkGap;
  int y = rows_[row].back().wire + 4;
  for (const std::string& line : remarkLines(sheet_.rows[row])) {
    text(x, y, Anchor::Start, Style::Remark, line);
    y += lineHeight(Style::Remark);
  }
  for (LinkedText& line : useLines(sheet_.rows[row])) {
    text(x, y, Anchor::Start, Style::Uses, std::move(line));
    y += lineHeight(Style::Uses);
  }
}

void Layout::drawJoint(uint32_t cell) {
  const Cell& here = sheet_.cells[cell];
  const int x = left_[cell];
  picture_.wires.push_back({{x, wireOf(cell, here.firstRow)}, {x, wireOf(cell, here.lastRow)}, cell});
}

void Layout::drawSymbol(uint32_t cell) {
  const Cell& here = sheet_.cells[cell];
  const Measure& m = measures_[cell];
  const int y = wireOf(cell, here.firstRow);
  const int middle = left_[cell] + m.width / 2;
  const bool slash = here.mark == "/";
  picture_.symbols.push_back(
      {here.kind == Kind::Coil ? Glyph::Coil : Glyph::Contact, slash, {leftPort(cell), y}, m.symbol, cell});
  if (!slash) text(middle, y + 4, Anchor::Middle, Style::Mark, here.mark);
  int up = y - kSymbolHalf - 5;
  text(middle, up, Anchor::Middle, Style::Name, here.operand.name, here.operand.link);
  up -= lineHeight(Style::Name);
  for (size_t i = m.note.size(); i-- > 0; up -= lineHeight(Style::Note))
    text(middle, up, Anchor::Middle, Style::Note, m.note[i]);
  int down = y + kSymbolHalf + lineHeight(Style::Address);
  LinkedText under = underline(here);
  const bool bare = under.text.empty();
  text(middle, down, Anchor::Middle, Style::Address, std::move(under));
  if (!bare) down += lineHeight(Style::Badge);
  text(middle, down, Anchor::Middle, Style::Badge, here.badge);
  halo(here, {leftPort(cell) - kHalo, y - kSymbolHalf - kHalo + 1}, m.symbol + 2 * kHalo,
       2 * (kSymbolHalf + kHalo - 1));
}

void Layout::halo(const Cell& cell, Point corner, int width, int height) {
  if (cell.seen != Seen::Unasked) picture_.halos.push_back({corner, width, height, cell.seen, cell.detail});
}

// Returns the baseline of the next operand.
int Layout::drawOperand(const OperandPlace& place, const std::vector<std::string>& note) {
  const Operand& operand = sheet_.cells[place.cell].operands[place.operand];
  const int value = place.value, nameEnd = value + widthOf(operand.name, Style::Name) + kPad;
  int y = place.y;
  text(place.label, y, Anchor::Start, kLabel, operand.label);
  text(value, y, Anchor::Start, Style::Name, operand.name, operand.link);
  text(nameEnd, y, Anchor::Start, Style::Address, operand.address);
  if (valueSpace_ > 0 && hasValue(operand))
    picture_.values.push_back({{nameEnd + addressWidth(operand), y}, place.cell, place.operand});
  for (const std::string& line : note) {
    y += lineHeight(Style::Note);
    text(value, y, Anchor::Start, Style::Note, line);
  }
  return y + lineHeight(Style::Name) + 2;
}

void Layout::drawBox(uint32_t cell) {
  const Cell& here = sheet_.cells[cell];
  const Measure& m = measures_[cell];
  const int top = wireOf(cell, here.firstRow) - m.above;
  const int x = left_[cell];
  const int bottom = std::max(top + kHead + m.body, wireOf(cell, here.lastRow) + kSymbolHalf);
  picture_.frames.push_back({{x, top}, m.width, bottom - top, kHead, cell});
  text(x + m.width / 2, top + 15, Anchor::Middle, Style::Title, here.title, here.link);
  for (uint32_t i = 0; i < here.pins.size(); ++i)
    text(x + 5, wireOf(cell, here.firstRow + i) + 4, Anchor::Start, Style::Pin, here.pins[i]);
  int y = top + kHead + lineHeight(Style::Name);
  const int label = x + kPad + m.pins;
  for (uint32_t i = 0; i < here.operands.size(); ++i)
    y = drawOperand({cell, i, label, label + m.labels, y}, m.notes[i]);
  text(label + m.labels, y, Anchor::Start, Style::Badge, here.badge);
  halo(here, {x, top}, m.width, bottom - top);
}

void Layout::draw() {
  for (uint32_t row = 0; row < sheet_.rows.size(); ++row) {
    drawRow(row);
    drawRemark(row);
  }
  for (uint32_t cell = 0; cell < sheet_.cells.size(); ++cell) {
    switch (sheet_.cells[cell].kind) {
    case Kind::Rail: break;
    case Kind::Joint: drawJoint(cell); break;
    case Kind::Contact:
    case Kind::Coil: drawSymbol(cell); break;
    case Kind::Box: drawBox(cell); break;
    }
  }
}

Picture Layout::run(int rail) {
  cut(rail);
  alignRight();
  placeRows();
  draw();
  picture_.rail = rail_;
  picture_.width = rail_ + kMargin;
  return std::move(picture_);
}

} // namespace

int neededRail(const Sheet& sheet, int valueSpace) { return Layout(sheet, valueSpace).rail(); }
Picture layOut(const Sheet& sheet, int rail, int valueSpace) { return Layout(sheet, valueSpace).run(rail); }

// Chooses among the cut positions in the right part of a band the one that cuts the fewest wires.

namespace {

bool isSolid(const Cell& cell) { return cell.kind != Cell::Kind::Rail && cell.kind != Cell::Kind::Joint; }

// Cut positions: before cells that no cell to their left overlaps.
std::vector<int> places(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& width) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < sheet.cells.size(); ++i)
    if (isSolid(sheet.cells[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return left[a] < left[b]; });
  std::vector<int> result;
  int end = 0;
  for (uint32_t cell : order) {
    if (end > 0 && end <= left[cell] && (result.empty() || result.back() < left[cell])) result.push_back(left[cell]);
    end = std::max(end, left[cell] + width[cell]);
  }
  return result;
}

// By cut position, the number of wires that it cuts.
std::vector<int> wiresAt(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& places) {
  std::vector<int> wires(places.size() + 1, 0);
  const auto index = [&](uint32_t cell) {
    return std::upper_bound(places.begin(), places.end(), left[cell]) - places.begin();
  };
  for (const Row& row : sheet.rows) {
    for (size_t i = 1; i < row.stops.size(); ++i) {
      if (!row.stops[i].joined) continue;
      ++wires[static_cast<size_t>(index(row.stops[i - 1].cell))];
      --wires[static_cast<size_t>(index(row.stops[i].cell))];
    }
  }
  std::partial_sum(wires.begin(), wires.end(), wires.begin());
  return wires;
}

} // namespace

Cuts chooseCuts(const Sheet& sheet, const std::vector<int>& left, const std::vector<int>& width, int needed, int rail) {
  const std::vector<int> all = places(sheet, left, width);
  const std::vector<int> wires = wiresAt(sheet, left, all);
  Cuts cuts;
  int start = 0; // difference between x in the whole and x in the band
  size_t at = 0;
  while (needed - start > rail) {
    size_t best = all.size();
    for (; at < all.size() && (all[at] <= start + rail - kBandEnd || best == all.size()); ++at) {
      const bool late = all[at] > start + rail / 2 + kBandEnd;
      if (best == all.size() || !late || wires[at] <= wires[best]) best = at;
    }
    if (best == all.size()) break;
    cuts.push_back(all[best]);
    start = all[best] - kBandStart;
    at = best + 1;
  }
  return cuts;
}

// Cuts at the breaks of the layout.

namespace {

// Tops of the parts, and the bottom of the last.
std::vector<int> edgesOf(const Picture& picture, int most) {
  std::vector<int> edges{picture.top};
  int last = picture.top; // the last break so far
  for (int at : picture.breaks) {
    if (at - edges.back() > most && last > edges.back()) edges.push_back(last);
    last = at;
  }
  const int end = picture.top + picture.height;
  if (end - edges.back() > most && last > edges.back()) edges.push_back(last);
  edges.push_back(end);
  return edges;
}

class Cutter {
public:
  explicit Cutter(const std::vector<int>& edges) : edges_(edges), pieces_(edges.size() - 1) {}

  std::vector<Picture> run(const Picture& picture) {
    for (size_t i = 0; i < pieces_.size(); ++i) {
      pieces_[i].width = picture.width;
      pieces_[i].rail = picture.rail;
      pieces_[i].top = edges_[i];
      pieces_[i].height = edges_[i + 1] - edges_[i];
    }
    for (const Line& wire : picture.wires) addWire(wire);
    for (Point dot : picture.dots) at(dot.y).dots.push_back(dot);
    for (const Symbol& symbol : picture.symbols) at(symbol.left.y).symbols.push_back(symbol);
    for (const Frame& frame : picture.frames) at(frame.corner.y).frames.push_back(frame);
    for (const Halo& halo : picture.halos) at(halo.corner.y).halos.push_back(halo);
    for (const Step& step : picture.steps) at(step.corner.y).steps.push_back(step);
    for (const Line& bar : picture.bars) at(bar.from.y).bars.push_back(bar);
    for (const Point arrow : picture.arrows) at(arrow.y).arrows.push_back(arrow);
    for (const Text& text : picture.texts) at(text.at.y).texts.push_back(text);
    for (const ValueSpace& value : picture.values) at(value.at.y).values.push_back(value);
    return std::move(pieces_);
  }

private:
  size_t indexAt(int y) const {
    const auto edge = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, y);
    return static_cast<size_t>(edge - edges_.begin()) - 1;
  }
  Picture& at(int y) { return pieces_[indexAt(y)]; }

  void addWire(const Line& wire) {
    for (size_t i = indexAt(wire.from.y); i <= indexAt(wire.to.y); ++i) {
      const int from = std::max(wire.from.y, edges_[i]);
      const int to = std::min(wire.to.y, edges_[i + 1]);
      pieces_[i].wires.push_back({{wire.from.x, from}, {wire.to.x, to}, wire.cell});
    }
  }

  const std::vector<int>& edges_;
  std::vector<Picture> pieces_;
};

} // namespace

std::vector<Picture> piecesOf(const Picture& picture, int most) {
  const std::vector<int> edges = edgesOf(picture, most);
  if (edges.size() == 2) return {picture};
  return Cutter(edges).run(picture);
}

} // namespace rung::view
