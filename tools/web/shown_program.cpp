// Rows, drawings and the power in them (see shown_program.h).
#include "tools/web/shown_program.h"

#include <algorithm>

#include "ir/support/put.h"
#include "tools/view/svg.h"

namespace rung::web {
namespace {

using view::Block;
using view::Cell;
using view::escaped;

// Heights in pixels; app.css has the same.
constexpr int kCaption = 32;
constexpr int kLine = 19; // of a comment
constexpr int kAfter = 18;
constexpr int kPhone = 360; // pixels of a line of text on a telephone
constexpr int kHeading = 60;
constexpr int kSection = 46;
constexpr int kValueSpace = 88;                           // pixels beside the operands of boxes
constexpr int kMostRail[kWidths] = {INT32_MAX, 600, 352}; // x of the right rail, by Width

// What charts draw for a language of instructions: the value of a register that an earlier rung has set, the opposite
// of the power, and the exclusive or.
constexpr std::string_view kExclusiveMark = "=1";
constexpr std::string_view kResultRegister = "RLO";
constexpr std::string_view kStackRegister = "STACK";
bool isRegister(const Cell& cell) {
  const std::string& name = cell.operand.name;
  const bool drawn = cell.kind == Cell::Kind::Contact || cell.kind == Cell::Kind::Coil;
  return drawn && cell.operand.link.to != view::Link::To::Name && cell.mark.empty() &&
         (name == kResultRegister || name == kStackRegister);
}
bool isComplement(const Cell& cell) { return cell.kind == Cell::Kind::Contact && cell.mark == "NOT"; }

std::array<int, kWidths> allWidths(int height) {
  std::array<int, kWidths> heights{};
  heights.fill(height);
  return heights;
}

// Of a comment, which is wrapped on a telephone alone.
int linesOf(std::string_view text, Width width) {
  int lines = 0;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const bool wraps = width == Width::Phone;
    lines += wraps ? std::max(1, static_cast<int>(view::wrap(line, view::Style::Comment, kPhone).size())) : 1;
    at = end + 1;
  }
  return lines;
}

int heightOfBlock(const Block& block, Width width) {
  switch (block.kind) {
  case Block::Kind::File: return kHeading;
  case Block::Kind::Module:
    return kHeading + (block.comment.empty() ? 0 : kLine) + (block.callers.rungs.empty() ? 0 : kLine);
  case Block::Kind::Section: return kSection + (block.comment.empty() ? 0 : kLine);
  case Block::Kind::Comment: return linesOf(block.text, width) * kLine + 10;
  case Block::Kind::Rung:
  case Block::Kind::Chart: break;
  }
  return 0;
}

void appendLinks(std::string& out, const std::vector<uint32_t>& rungs) {
  for (size_t i = 0; i < rungs.size(); ++i) put(out, "{0}<a href=\"#r{1}\">{1}</a>", i == 0 ? "" : ", ", rungs[i]);
}

std::string headingHtml(int level, const Block& block) {
  std::string out = fmt::format("<h{0}>{1}{2}{3}</h{0}>", level, escaped(block.text), block.title.empty() ? "" : ": ",
                                escaped(block.title));
  if (!block.comment.empty()) put(out, "<p>{}</p>", escaped(block.comment));
  if (block.kind == Block::Kind::Module && !block.callers.rungs.empty()) {
    put(out, "<p>{} ", block.callers.lead);
    appendLinks(out, block.callers.rungs);
    out += "</p>";
  }
  return out;
}

std::string commentHtml(std::string_view text) {
  std::string out = "<p class=\"remark\">";
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    put(out, "{}{}", at == 0 ? "" : "<br>", escaped(text.substr(at, end - at)));
    at = end + 1;
  }
  return out + "</p>";
}

} // namespace

// ---- rows -----------------------------------------------------------------------------------------------------

void ShownProgram::addRow(Row row) {
  row.firstElement = elements_;
  elements_ += row.elements;
  if (row.kind == Row::Kind::Rung) rowsByRung_.emplace(row.number, static_cast<uint32_t>(rows_.size()));
  rows_.push_back(row);
}

ShownProgram::Path ShownProgram::pathOf(const view::Sheet& sheet) {
  Path path;
  path.from.resize(sheet.cells.size());
  path.to.resize(sheet.cells.size());
  for (const view::Row& row : sheet.rows) {
    for (size_t i = 1; i < row.stops.size(); ++i) {
      if (!row.stops[i].joined) continue;
      path.from[row.stops[i].cell].push_back(row.stops[i - 1].cell);
      path.to[row.stops[i - 1].cell].push_back(row.stops[i].cell);
    }
  }
  return path;
}

void ShownProgram::addFigure(uint32_t index) {
  const view::Figure& figure = drawing_.figures[index];
  paths_.push_back(pathOf(figure.sheet));
  const bool isChart = figure.chart != view::kNoChart;
  const view::Picture picture = pictureOf(figure, Width::Wide);
  const int comments = static_cast<int>(figure.comments.size()) * kLine;
  const int texts = kCaption + comments + kAfter;
  std::array<int, kWidths> heights = allWidths(texts + picture.height);
  for (size_t width = 1; width < kWidths && !isChart; ++width)
    heights[width] = texts + pictureOf(figure, static_cast<Width>(width)).height;
  const uint32_t first = elements_;
  const auto row = static_cast<uint32_t>(rows_.size());
  addRow({.kind = Row::Kind::Rung,
          .heights = heights,
          .number = figure.number,
          .index = index,
          .elements = static_cast<uint32_t>(isChart ? picture.steps.size() : figure.sheet.cells.size())});
  if (isChart) return;
  for (uint32_t i = 0; i < figure.sheet.cells.size(); ++i) {
    const view::Place& place = figure.sheet.cells[i].place;
    if (place.line == 0 || isRegister(figure.sheet.cells[i])) continue;
    byPlace_.emplace(Key{row, place.line, place.column}, first + i);
  }
}

void ShownProgram::addChart(uint32_t index) {
  const view::Picture picture = view::layOut(drawing_.charts[index]);
  addRow({.kind = Row::Kind::Chart,
          .heights = allWidths(picture.height + kAfter),
          .index = index,
          .elements = static_cast<uint32_t>(picture.steps.size())});
}

ShownProgram::ShownProgram(view::Program program)
    : drawing_(std::move(program)), rail_(view::commonRail(drawing_, kValueSpace)) {
  for (const Block& block : drawing_.blocks) {
    if (block.kind == Block::Kind::Rung)
      addFigure(block.figure);
    else if (block.kind == Block::Kind::Chart)
      addChart(block.figure);
    else
      addRow({.kind = static_cast<Row::Kind>(block.kind),
              .heights = {heightOfBlock(block, Width::Wide), heightOfBlock(block, Width::Tablet),
                          heightOfBlock(block, Width::Phone)}});
  }
}

std::vector<view::ContentsEntry> ShownProgram::contents() const { return view::contentsOf(drawing_); }

view::Picture ShownProgram::pictureOf(const view::Figure& figure, Width width) const {
  if (figure.chart != view::kNoChart) return view::layOut(drawing_.charts[figure.chart]);
  return view::layOut(figure.sheet, std::min(rail_, kMostRail[static_cast<size_t>(width)]), kValueSpace);
}

const view::Chart* ShownProgram::chartOf(const Row& row) const {
  if (row.kind == Row::Kind::Chart) return &drawing_.charts[row.index];
  if (row.kind != Row::Kind::Rung || drawing_.figures[row.index].chart == view::kNoChart) return nullptr;
  return &drawing_.charts[drawing_.figures[row.index].chart];
}

std::string ShownProgram::rungHtml(uint32_t row, Width width) const {
  const view::Figure& figure = drawing_.figures[rows_[row].index];
  std::string out = fmt::format("<div class=\"cap\"><b>{}</b><span>{}</span><i>{}</i></div>", figure.number,
                                escaped(view::captionOf(figure)), escaped(view::textOf(drawing_, figure.place)));
  for (const std::string& comment : figure.comments) put(out, "<p>{}</p>", escaped(comment));
  return out + drawingHtml(rows_[row], width);
}

std::string ShownProgram::drawingHtml(const Row& row, Width width) const {
  const view::Chart* chart = chartOf(row);
  const view::Picture picture = chart != nullptr ? view::layOut(*chart) : pictureOf(drawing_.figures[row.index], width);
  std::string out = fmt::format("<svg aria-hidden=\"true\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">",
                                picture.width, picture.height);
  if (chart != nullptr)
    view::appendLiveChart(out, picture);
  else
    view::appendLivePicture(out, picture, drawing_.figures[row.index].sheet);
  return out + "</svg>";
}

std::vector<uint32_t> ShownProgram::elementsAt(uint32_t row, uint32_t line, uint32_t column) const {
  std::vector<uint32_t> elements;
  for (auto [at, end] = byPlace_.equal_range(Key{row, line, column}); at != end; ++at) elements.push_back(at->second);
  if (column != 0 || !elements.empty()) return elements;
  const auto at = byPlace_.lower_bound(Key{row, line, 0});
  const auto end = byPlace_.lower_bound(Key{row, line + 1, 0});
  if (at != end && std::next(at) == end) elements.push_back(at->second);
  return elements;
}

const Cell& ShownProgram::cellOf(uint32_t row, uint32_t element) const {
  return drawing_.figures[rows_[row].index].sheet.cells[element - rows_[row].firstElement];
}

std::optional<uint32_t> ShownProgram::railOf(uint32_t row) const {
  const Row& one = rows_[row];
  const bool sheet = one.kind == Row::Kind::Rung && chartOf(one) == nullptr && one.elements > 0;
  return sheet ? std::optional(one.firstElement) : std::nullopt;
}

std::vector<uint32_t> ShownProgram::poweredOf(uint32_t row) const {
  std::vector<uint32_t> elements;
  if (!railOf(row)) return elements;
  const std::vector<Cell>& cells = drawing_.figures[rows_[row].index].sheet.cells;
  for (uint32_t i = 0; i < cells.size(); ++i)
    if (cells[i].kind == Cell::Kind::Coil || cells[i].kind == Cell::Kind::Box)
      elements.push_back(rows_[row].firstElement + i);
  return elements;
}

std::optional<uint32_t> ShownProgram::rowOf(uint32_t rung) const {
  const auto at = rowsByRung_.find(rung);
  return at == rowsByRung_.end() ? std::nullopt : std::optional(at->second);
}

std::string ShownProgram::nameOf(uint32_t row) const {
  return rows_[row].kind == Row::Kind::Rung ? view::nameOf(drawing_.figures[rows_[row].index]) : "";
}

const std::string& ShownProgram::titleOf(uint32_t row) const {
  const bool rung = rows_[row].kind == Row::Kind::Rung;
  return rung ? drawing_.figures[rows_[row].index].title : drawing_.blocks[row].text;
}

std::string ShownProgram::html(uint32_t row, Width width) const {
  const Row& one = rows_[row];
  if (one.kind == Row::Kind::Rung) return rungHtml(row, width);
  if (one.kind == Row::Kind::Chart) return drawingHtml(one, width);
  const Block& block = drawing_.blocks[row];
  if (one.kind == Row::Kind::Comment) return commentHtml(block.text);
  return headingHtml(one.kind == Row::Kind::Section ? 3 : 2, block);
}

// The power in one sheet, from the states of its elements.
class ShownProgram::Power {
public:
  Power(const view::Sheet& sheet, const Path& path, std::span<const uint8_t> states)
      : sheet_(sheet), path_(path), states_(states), after_(states.size()) {}

  // A character for each cell, see ShownProgram::flow.
  std::string run() {
    std::string text(states_.size(), '-');
    for (uint32_t cell = 0; cell < text.size(); ++cell)
      if (const std::optional<bool> isOn = on(cell))
        text[cell] = static_cast<char>('0' + (*isOn ? 1 : 0) + (after(cell) ? 2 : 0));
    return text;
  }

private:
  const Cell& at(uint32_t cell) const { return sheet_.cells[cell]; }
  bool isOn(uint32_t cell) const { return (states_[cell] & kOn) != 0; }

  std::optional<bool> state(uint32_t cell) const {
    return (states_[cell] & (kEvaluated | kConstant)) != 0 ? std::optional(isOn(cell)) : std::nullopt;
  }

  // Whether there is power at the left of the cell, and at its right.
  bool before(uint32_t cell) {
    return std::ranges::any_of(path_.from[cell], [&](uint32_t from) { return after(from); });
  }
  bool after(uint32_t cell) {
    if (!after_[cell]) after_[cell] = passes(cell);
    return *after_[cell];
  }

  // Whether anything at the left of the cell was evaluated.
  bool isReached(uint32_t cell) {
    return std::ranges::any_of(path_.from[cell], [&](uint32_t from) {
      return at(from).kind == Cell::Kind::Joint ? isReached(from) : on(from).has_value();
    });
  }

  bool passes(uint32_t cell) {
    switch (at(cell).kind) {
    case Cell::Kind::Rail: return true;
    case Cell::Kind::Joint:
    case Cell::Kind::Coil: return before(cell);
    case Cell::Kind::Box: return leavesBox(cell);
    case Cell::Kind::Contact: break;
    }
    const bool isOn = on(cell).value_or(false);
    return isOn && (isComplement(at(cell)) || before(cell));
  }

  bool leavesBox(uint32_t cell) {
    const uint8_t state = states_[cell];
    if (at(cell).mark == kExclusiveMark) return exclusive(cell);
    if ((state & kResultKnown) == 0) return before(cell);
    return (state & kResult) != 0 && ((state & kConducts) == 0 || before(cell));
  }

  // Of the two inputs, or of one and the bit that it reads.
  bool exclusive(uint32_t cell) {
    const std::vector<uint32_t>& from = path_.from[cell];
    const bool first = !from.empty() && after(from.front());
    return first != (from.size() > 1 ? after(from.back()) : isOn(cell));
  }

  // Whether the cell is on; nothing: it was not evaluated.
  std::optional<bool> on(uint32_t cell) {
    const Cell& one = at(cell);
    const bool follows = one.kind == Cell::Kind::Coil && isRegister(one);
    if (one.kind == Cell::Kind::Rail || one.kind == Cell::Kind::Joint || follows) return before(cell);
    if (isComplement(one)) return isReached(cell) ? std::optional(!before(cell)) : std::nullopt;
    if (isRegister(one)) return stored(cell);
    if (one.mark == kExclusiveMark) return exclusive(cell);
    return (states_[cell] & kWired) != 0 ? std::optional(before(cell)) : state(cell);
  }

  // The value of a register at its contact: what an output before it has stored, else what follows needs.
  std::optional<bool> stored(uint32_t cell) {
    for (uint32_t earlier = cell; earlier-- > 0;) {
      const Cell& one = at(earlier);
      if (one.kind != Cell::Kind::Coil && one.kind != Cell::Kind::Box) continue;
      if (isRegister(one) && one.operand.name == at(cell).operand.name) return before(earlier);
      // Every output that depends on the result has got it.
      const bool got = !isRegister(one) && (states_[earlier] & kWired) == 0;
      if (got && at(cell).operand.name == kResultRegister) return state(earlier);
    }
    return wanted(cell);
  }

  // The power after a cell, as far as what it leads to says.
  std::optional<bool> wanted(uint32_t cell) const {
    for (const uint32_t next : path_.to[cell]) {
      const std::optional<bool> into = wantedInto(next);
      if (into && (!*into || path_.from[next].size() == 1)) return into;
    }
    return std::nullopt;
  }

  std::optional<bool> wantedInto(uint32_t cell) const {
    switch (at(cell).kind) {
    case Cell::Kind::Coil:
    case Cell::Kind::Box: return at(cell).mark == kExclusiveMark ? std::nullopt : state(cell);
    case Cell::Kind::Joint: return wanted(cell);
    case Cell::Kind::Rail: return std::nullopt;
    case Cell::Kind::Contact: break;
    }
    if (!isComplement(at(cell))) return state(cell).value_or(false) ? wanted(cell) : std::nullopt;
    const std::optional<bool> out = wanted(cell);
    return out ? std::optional(!*out) : std::nullopt;
  }

  const view::Sheet& sheet_;
  const Path& path_;
  const std::span<const uint8_t> states_;
  std::vector<std::optional<bool>> after_; // by cell, as far as it has been found
};

std::string ShownProgram::flow(uint32_t row, std::span<const uint8_t> states) const {
  const Row& one = rows_[row];
  if (states.empty()) return {};
  const std::span<const uint8_t> own = states.subspan(one.firstElement, one.elements);
  if (std::ranges::none_of(own, [](uint8_t state) { return (state & kEvaluated) != 0; })) return {};
  if (chartOf(one) == nullptr) return Power(drawing_.figures[one.index].sheet, paths_[one.index], own).run();
  std::string text(own.size(), '-');
  for (size_t i = 0; i < own.size(); ++i)
    if ((own[i] & kEvaluated) != 0) text[i] = (own[i] & kOn) != 0 ? '1' : '0';
  return text;
}

std::vector<ShownProgram::Contact> ShownProgram::contacts() const {
  std::vector<Contact> found;
  for (const Row& row : rows_) {
    if (row.kind != Row::Kind::Rung || chartOf(row) != nullptr) continue;
    const std::vector<Cell>& cells = drawing_.figures[row.index].sheet.cells;
    for (uint32_t i = 0; i < cells.size(); ++i)
      if (cells[i].kind == Cell::Kind::Contact)
        found.push_back({row.firstElement + i, cells[i].operand.name, cells[i].mark == "/"});
  }
  return found;
}

std::map<uint32_t, std::set<std::string>> ShownProgram::shapes() const {
  std::map<uint32_t, std::set<std::string>> shapes;
  for (const view::Figure& figure : drawing_.figures) {
    for (const Cell& cell : figure.sheet.cells) {
      if (cell.operand.link.to != view::Link::To::Name) continue;
      const std::string mark = cell.mark.empty() ? " " : cell.mark;
      if (cell.kind == Cell::Kind::Contact) shapes[cell.operand.link.id].insert("|" + mark + "|");
      if (cell.kind == Cell::Kind::Coil) shapes[cell.operand.link.id].insert("(" + mark + ")");
    }
  }
  return shapes;
}

std::vector<ShownProgram::Step> ShownProgram::steps() const {
  std::vector<Step> found;
  for (const Row& row : rows_) {
    const view::Chart* chart = chartOf(row);
    if (chart == nullptr) continue;
    const view::Picture picture = view::layOut(*chart);
    for (uint32_t i = 0; i < picture.steps.size(); ++i)
      found.push_back({row.firstElement + i, chart->sequence.continuation, picture.steps[i].states});
  }
  return found;
}

std::vector<ShownProgram::ShownValue> ShownProgram::values(uint32_t row) const {
  std::vector<ShownValue> found;
  if (rows_[row].kind != Row::Kind::Rung || chartOf(rows_[row]) != nullptr) return found;
  const view::Sheet& sheet = drawing_.figures[rows_[row].index].sheet;
  for (uint32_t cell = 0; cell < sheet.cells.size(); ++cell)
    for (uint32_t i = 0; i < sheet.cells[cell].operands.size(); ++i)
      if (const view::Operand& operand = sheet.cells[cell].operands[i]; operand.link.to == view::Link::To::Name)
        found.push_back({operand.name, cell, i});
  return found;
}

} // namespace rung::web
