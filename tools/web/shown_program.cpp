// Rows, drawings and the power in them (see shown_program.h).
#include "tools/web/shown_program.h"

#include <algorithm>
#include <numeric>

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
constexpr int kHeading = 60;
constexpr int kSection = 46;
constexpr int kSourceLine = 20;
constexpr int kValueSpace = 88;  // pixels beside the operands of boxes
constexpr int kNarrowRail = 352; // on a phone

int linesOf(std::string_view text) { return 1 + static_cast<int>(std::ranges::count(text, '\n')); }

int heightOfBlock(const Block& block) {
  switch (block.kind) {
  case Block::Kind::File: return kHeading;
  case Block::Kind::Module:
    return kHeading + (block.comment.empty() ? 0 : kLine) + (block.callers.rungs.empty() ? 0 : kLine);
  case Block::Kind::Section: return kSection + (block.comment.empty() ? 0 : kLine);
  case Block::Kind::Comment: return linesOf(block.text) * kLine + 10;
  case Block::Kind::Rung: break;
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

// ---- a drawing -----------------------------------------------------------------------------------------------------

void ShownProgram::addRow(Row row) {
  row.firstElement = elements_;
  elements_ += row.elements;
  if (row.kind == Row::Kind::Rung) rowsByRung_.emplace(row.number, static_cast<uint32_t>(rows_.size()));
  rows_.push_back(row);
  narrow_.push_back(row.height);
}

ShownProgram::Path ShownProgram::pathOf(const view::Sheet& sheet) {
  Path path;
  path.order.resize(sheet.cells.size());
  std::iota(path.order.begin(), path.order.end(), 0u);
  std::ranges::stable_sort(path.order, {}, [&](uint32_t cell) { return sheet.cells[cell].column; });
  path.from.resize(sheet.cells.size());
  for (const view::Row& row : sheet.rows)
    for (size_t i = 1; i < row.stops.size(); ++i)
      if (row.stops[i].joined) path.from[row.stops[i].cell].push_back(row.stops[i - 1].cell);
  return path;
}

void ShownProgram::addFigure(uint32_t index) {
  const view::Figure& figure = drawing_.figures[index];
  paths_.push_back(pathOf(figure.sheet));
  const int comments = static_cast<int>(figure.comments.size()) * kLine;
  const int texts = kCaption + comments + kAfter;
  const uint32_t first = elements_;
  addRow({.kind = Row::Kind::Rung,
          .height = texts + pictureOf(figure, false).height,
          .number = figure.number,
          .index = index,
          .elements = static_cast<uint32_t>(figure.sheet.cells.size())});
  narrow_.back() = texts + pictureOf(figure, true).height;
  for (uint32_t i = 0; i < figure.sheet.cells.size(); ++i) {
    const view::Place& place = figure.sheet.cells[i].place;
    if (place.line > 0) byPlace_.emplace(Key{drawing_.files[place.file].path, place.line, place.column}, first + i);
  }
}

ShownProgram::ShownProgram(view::Program program)
    : drawing_(std::move(program)), rail_(view::commonRail(drawing_, kValueSpace)) {
  for (const Block& block : drawing_.blocks) {
    if (block.kind == Block::Kind::Rung)
      addFigure(block.figure);
    else
      addRow({.kind = static_cast<Row::Kind>(block.kind), .height = heightOfBlock(block)});
  }
}

std::vector<view::ContentsEntry> ShownProgram::contents() const { return view::contentsOf(drawing_); }

view::Picture ShownProgram::pictureOf(const view::Figure& figure, bool narrow) const {
  return view::layOut(figure.sheet, narrow ? kNarrowRail : rail_, kValueSpace);
}

std::string ShownProgram::figureHtml(uint32_t row, bool narrow) const {
  const view::Figure& figure = drawing_.figures[rows_[row].index];
  std::string out = fmt::format("<div class=\"cap\"><b>{}</b><span>{}</span><i>{}</i></div>", figure.number,
                                escaped(figure.title), escaped(view::textOf(drawing_, figure.place)));
  for (const std::string& comment : figure.comments) put(out, "<p>{}</p>", escaped(comment));
  const view::Picture picture = pictureOf(figure, narrow);
  put(out, "<svg aria-hidden=\"true\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">", picture.width,
      picture.height);
  view::appendLivePicture(out, picture, figure.sheet);
  return out + "</svg>";
}

// ---- a listing -----------------------------------------------------------------------------------------------------

ShownProgram::ShownProgram(view::Listing listing, const replay::Elements& elements) : texts_(std::move(listing.texts)) {
  drawing_.title = std::move(listing.title);
  drawing_.control = std::move(listing.control);
  std::map<uint32_t, std::map<Key, std::string>> byRung;
  for (const replay::Element& element : elements.all()) {
    const replay::SourceRung& rung = elements.rungs()[element.rung];
    byRung[rung.number].emplace(Key{rung.file, element.line, element.column}, element.pins[0].text);
  }
  std::string routine;
  for (view::TableRow& one : listing.rows) {
    if (one.routine != routine || rows_.empty()) {
      routine = one.routine;
      Block& block = drawing_.blocks.emplace_back();
      block.kind = Block::Kind::Module;
      block.text = routine;
      addRow({.kind = Row::Kind::Module, .height = kHeading});
    }
    Source source{std::move(one), {}, {}};
    const uint32_t first = elements_;
    for (const auto& [key, text] : byRung[source.row.number]) {
      byPlace_.emplace(key, first + static_cast<uint32_t>(source.elements.size()));
      source.elements.push_back(key);
      source.texts.push_back(text);
    }
    const int lines =
        source.row.place.line == 0 ? 0 : static_cast<int>(source.row.lastLine - source.row.place.line) + 1;
    view::Figure& figure = drawing_.figures.emplace_back(); // for the contents
    figure.number = source.row.number;
    figure.title = source.row.title;
    Block& block = drawing_.blocks.emplace_back();
    block.kind = Block::Kind::Rung;
    block.figure = static_cast<uint32_t>(sources_.size());
    addRow({.kind = Row::Kind::Rung,
            .height = kCaption + lines * kSourceLine + kAfter,
            .number = source.row.number,
            .index = static_cast<uint32_t>(sources_.size()),
            .elements = static_cast<uint32_t>(source.elements.size())});
    sources_.push_back(std::move(source));
  }
}

namespace {

// Bytes of the first `characters` characters of UTF-8.
size_t bytesOf(std::string_view text, size_t characters) {
  size_t at = 0;
  for (; at < text.size() && characters > 0; --characters) do
      ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80);
  return at;
}

} // namespace

// Each element's text is marked where it begins; one that the line does not have as written is marked up to its blank.
std::string ShownProgram::sourceHtml(uint32_t row) const {
  const Source& source = sources_[rows_[row].index];
  std::string out = fmt::format("<div class=\"cap\"><b>{}</b><span>{}</span><i>{}:{}</i></div><pre>", source.row.number,
                                escaped(source.row.title), escaped(source.row.place.file), source.row.place.line);
  const auto file = texts_.find(source.row.place.file);
  if (file == texts_.end() || source.row.place.line == 0) return out + "</pre>";
  for (uint32_t line = source.row.place.line; line <= source.row.lastLine && line <= file->second.size(); ++line) {
    const std::string_view text = file->second[line - 1];
    put(out, "<i>{}</i>", line);
    size_t at = 0;
    for (size_t i = 0; i < source.elements.size(); ++i) {
      const auto& [path, ofLine, column] = source.elements[i];
      if (ofLine != line) continue;
      const size_t begin = column == 0 ? text.find_first_not_of(" \t") : bytesOf(text, column - 1);
      if (begin == std::string_view::npos || begin < at || begin >= text.size()) continue;
      const bool written = text.substr(begin).starts_with(source.texts[i]);
      const size_t end =
          written ? begin + source.texts[i].size() : std::min(text.find_first_of(" \t;", begin + 1), text.size());
      put(out, "{}<span class=\"el\" data-c=\"{}\" data-name=\"{}\">{}</span>", escaped(text.substr(at, begin - at)), i,
          escaped(source.texts[i]), escaped(text.substr(begin, end - begin)));
      at = end;
    }
    put(out, "{}\n", escaped(text.substr(at)));
  }
  return out + "</pre>";
}

// ---- both ----------------------------------------------------------------------------------------------------------

std::optional<uint32_t> ShownProgram::elementAt(std::string_view file, uint32_t line, uint32_t column) const {
  const std::string path(file);
  if (const auto at = byPlace_.find(Key{path, line, column}); at != byPlace_.end()) return at->second;
  if (column != 0) return std::nullopt;
  const auto at = byPlace_.lower_bound(Key{path, line, 0});
  const auto end = byPlace_.lower_bound(Key{path, line + 1, 0});
  return at != end && std::next(at) == end ? std::optional(at->second) : std::nullopt;
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

std::string ShownProgram::html(uint32_t row, bool narrow) const {
  const Row& one = rows_[row];
  if (one.kind == Row::Kind::Rung) return sources_.empty() ? figureHtml(row, narrow) : sourceHtml(row);
  const Block& block = drawing_.blocks[row];
  if (one.kind == Row::Kind::Comment) return commentHtml(block.text);
  return headingHtml(one.kind == Row::Kind::Section ? 3 : 2, block);
}

namespace {

bool on(uint8_t state) { return (state & kOn) != 0; }

// Whether there is power after the cell.
bool passes(const Cell& cell, bool before, uint8_t state) {
  switch (cell.kind) {
  case Cell::Kind::Contact: return before && on(state);
  case Cell::Kind::Box:
    if ((state & kResultKnown) == 0) return before;
    return (state & kResult) != 0 && (before || (state & kConducts) == 0);
  case Cell::Kind::Rail:
  case Cell::Kind::Joint:
  case Cell::Kind::Coil: break;
  }
  return before;
}

} // namespace

std::string ShownProgram::flow(uint32_t row, std::span<const uint8_t> states) const {
  const Row& one = rows_[row];
  if (states.empty()) return {};
  const std::span<const uint8_t> own = states.subspan(one.firstElement, one.elements);
  if (std::ranges::none_of(own, [](uint8_t state) { return (state & kEvaluated) != 0; })) return {};
  std::string text(own.size(), '-');
  if (!sources_.empty()) {
    for (size_t i = 0; i < own.size(); ++i)
      if ((own[i] & kEvaluated) != 0) text[i] = on(own[i]) ? '1' : '0';
    return text;
  }
  const view::Sheet& sheet = drawing_.figures[one.index].sheet;
  const Path& path = paths_[one.index];
  std::vector<bool> power(own.size(), false);
  power[0] = true; // the left rail
  for (const uint32_t cell : path.order) {
    const Cell& here = sheet.cells[cell];
    const bool wire = here.kind == Cell::Kind::Rail || here.kind == Cell::Kind::Joint;
    bool before = here.kind == Cell::Kind::Rail;
    for (const uint32_t from : path.from[cell]) before = before || power[from];
    power[cell] = passes(here, before, own[cell]);
    if (!wire && (own[cell] & (kEvaluated | kConstant)) == 0) continue;
    text[cell] = static_cast<char>('0' + (wire ? before : on(own[cell])) + (power[cell] ? 2 : 0));
  }
  return text;
}

std::vector<ShownProgram::Contact> ShownProgram::contacts() const {
  std::vector<Contact> found;
  if (!sources_.empty()) return found;
  for (const Row& row : rows_) {
    if (row.kind != Row::Kind::Rung) continue;
    const std::vector<Cell>& cells = drawing_.figures[row.index].sheet.cells;
    for (uint32_t i = 0; i < cells.size(); ++i)
      if (cells[i].kind == Cell::Kind::Contact)
        found.push_back({row.firstElement + i, cells[i].operand.name, cells[i].mark == "/"});
  }
  return found;
}

std::vector<ShownProgram::ShownValue> ShownProgram::values(uint32_t row) const {
  std::vector<ShownValue> found;
  if (rows_[row].kind != Row::Kind::Rung || !sources_.empty()) return found;
  const view::Sheet& sheet = drawing_.figures[rows_[row].index].sheet;
  for (uint32_t cell = 0; cell < sheet.cells.size(); ++cell)
    for (uint32_t i = 0; i < sheet.cells[cell].operands.size(); ++i)
      if (const view::Operand& operand = sheet.cells[cell].operands[i]; operand.link.to == view::Link::To::Name)
        found.push_back({operand.name, cell, i});
  return found;
}

} // namespace rung::web
