// Writes the pages (see html.h) by filling in the files of page/.
#include "tools/view/html.h"

#include <algorithm>
#include <span>
#include <utility>

#include "ir/support/put.h"
#include "rtlib/text/blanks.h"
#include "tools/view/layout.h"
#include "tools/view/overlay.h"
#include "tools/view/style.h"
#include "tools/view/svg.h"

namespace rung::view {
namespace {

struct PageHead {
  std::string_view title;
  std::string_view control;
  size_t rungs = 0;
  std::string pictures; // CSS rules of the drawings
  std::string style;    // CSS rules of this page, after the common ones
};

// As a value of the CSS property `content`.
std::string cssText(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\' || c == '<' || static_cast<unsigned char>(c) < 0x20)
      put(out, "\\{:x} ", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + '"';
}

// "main.lad:12", with a link if there is one; nothing for a position without a line.
void appendPlace(std::string& out, const SourceFile& file, uint32_t line, const PageOptions& options) {
  if (line == 0) return;
  const std::string link = options.linkTo ? options.linkTo(file, line) : "";
  const std::string text = fmt::format("{}:{}", escaped(file.name), line);
  if (link.empty())
    put(out, "<i class=\"f\">{}</i>", text);
  else
    put(out, "<a class=\"f\" href=\"{}\">{}</a>", escaped(link), text);
}

// The common rules of all pages; colours are CSS properties, with other values in dark mode.
std::string commonRules() {
  std::string light;
  std::string dark;
  for (const ColourInfo& info : kColourInfos) {
    put(light, "--{}:{};", info.name, info.light);
    put(dark, "--{}:{};", info.name, info.dark);
  }
  const text::Mark marks[] = {{"LIGHT", light}, {"DARK", dark}};
  return text::filled(text::textOf(pageFiles(), "page.css"), marks);
}

std::string paperRules(const PageHead& head, const PageOptions& options) {
  std::string state = options.revision.empty() ? "" : "Revision " + options.revision;
  if (!options.date.empty()) state += (state.empty() ? "" : ", ") + options.date;
  const std::string values[] = {cssText(head.title), cssText(head.control), cssText(state)};
  const text::Mark marks[] = {{"TITLE", values[0]}, {"CONTROL", values[1]}, {"STATE", values[2]}};
  return text::filled(text::textOf(pageFiles(), "paper.css"), marks);
}

// On paper every page has the heading and a page number.
std::string wholePage(const PageHead& head, const PageOptions& options, std::string_view body) {
  const std::string title = escaped(head.title);
  const std::string style = commonRules() + head.pictures + paperRules(head, options) + head.style;
  std::string facts = fmt::format("<span>{}</span><span>{} rung{}</span>", escaped(head.control), head.rungs,
                                  head.rungs == 1 ? "" : "s");
  if (!options.revision.empty()) put(facts, "<span>Revision {}</span>", escaped(options.revision));
  if (!options.date.empty()) put(facts, "<span>{}</span>", escaped(options.date));
  const text::Mark marks[] = {{"TITLE", title},
                              {"STYLE", style},
                              {"FACTS", facts},
                              {"BODY", body},
                              {"SCRIPT", text::textOf(pageFiles(), "page.js")}};
  return text::filled(text::textOf(pageFiles(), "page.html"), marks);
}

// Results of runs: the summary at the top, a label at each rung.

// A rung in the summary.
struct RunRow {
  uint32_t number = 0;
  std::string_view title;
  const Run* run = nullptr;
};

struct RunsOnPage {
  const RunSummary* summary = nullptr;
  std::vector<RunRow> rungs;
  bool elements = false; // some rungs have coverage of their elements
};

constexpr size_t kListed = 10; // number of the most expensive rungs
constexpr int kBar = 90;       // length of the longest bar in pixels

// The largest share of a rung: colours and bars are relative to it.
double hottest(const std::vector<RunRow>& rungs) {
  double most = 0;
  for (const RunRow& row : rungs) most = std::max(most, row.run->heat);
  return most;
}

// CSS classes of a rung, " H3" or " N"; "" if nothing is known.
std::string classesOf(const Run& run, double hottest) {
  if (run.state == Run::State::Never) return " N";
  return run.state == Run::State::Ran ? fmt::format(" H{}", heatStep(run, hottest)) : "";
}

// The share of a rung, with a bar.
void appendRun(std::string& out, const Run& run, double hottest) {
  if (run.state == Run::State::Unasked) return;
  put(out, "<i class=\"o\"");
  if (!run.detail.empty()) put(out, " title=\"{}\"", escaped(run.detail));
  out += ">";
  const int bar = run.heat > 0 ? std::max(1, static_cast<int>(run.heat / hottest * kBar)) : 0;
  if (bar > 0) put(out, "<s class=\"s{}\" style=\"width:{}px\"></s>", heatStep(run, hottest), bar);
  put(out, "{}</i>", escaped(labelOf(run)));
}

void appendLegend(std::string& out, const RunsOnPage& runs) {
  out += "<p class=\"lg\">";
  if (!runs.summary->heat.empty()) {
    out += "<span>least ";
    for (int step = 1; step <= kHeatSteps; ++step) put(out, "<i class=\"sw H{}\"></i>", step);
    put(out, " most: {}</span>", escaped(runs.summary->heat));
  }
  const auto never = [](const RunRow& row) { return row.run->state == Run::State::Never; };
  if (std::any_of(runs.rungs.begin(), runs.rungs.end(), never))
    out += "<span><i class=\"sw N\"></i> rung that never ran</span>";
  if (runs.elements)
    out += "<span>contacts, coils and boxes: <i class=\"sw qa\"></i> all seen</span>"
           "<span><i class=\"sw qp\"></i> seen in part</span><span><i class=\"sw qn\"></i> never ran</span>";
  out += "</p>\n";
}

void appendMost(std::string& out, const RunsOnPage& runs) {
  std::vector<RunRow> rows;
  for (const RunRow& row : runs.rungs)
    if (row.run->heat > 0) rows.push_back(row);
  if (rows.empty()) return;
  std::stable_sort(rows.begin(), rows.end(),
                   [](const RunRow& a, const RunRow& b) { return a.run->heat > b.run->heat; });
  const double most = rows[0].run->heat;
  rows.resize(std::min(rows.size(), kListed));
  out += "<h3>Most</h3>\n<ol class=\"most\">\n";
  for (const RunRow& row : rows) {
    put(out, "<li><a href=\"#r{0}\">Rung {0}</a> <span>{1}</span> ", row.number, escaped(row.title));
    appendRun(out, *row.run, most);
    out += "</li>\n";
  }
  out += "</ol>\n";
}

// "4, 8–12": with a link to the first of neighbours.
void appendNever(std::string& out, const std::vector<RunRow>& rungs) {
  std::string list;
  size_t count = 0;
  for (size_t i = 0; i < rungs.size();) {
    size_t end = i;
    while (end < rungs.size() && rungs[end].run->state == Run::State::Never) ++end;
    if (end == i) {
      ++i;
      continue;
    }
    put(list, "{0}<a href=\"#r{1}\">{1}", list.empty() ? "" : ", ", rungs[i].number);
    if (end - i > 1) put(list, "\u2013{}", rungs[end - 1].number);
    list += "</a>";
    count += end - i;
    i = end;
  }
  if (count > 0) put(out, "<p>{} rung{} never ran: {}</p>\n", count, count == 1 ? "" : "s", list);
}

// Summary lines, legend, the most expensive rungs and those that never ran. Nothing without a summary.
void appendRuns(std::string& out, const RunsOnPage& runs) {
  if (runs.summary->title.empty()) return;
  put(out, "<section id=\"run\" aria-label=\"{0}\"><h2>{0}</h2>\n", escaped(runs.summary->title));
  for (const std::string& line : runs.summary->lines) put(out, "<p>{}</p>\n", escaped(line));
  appendLegend(out, runs);
  appendMost(out, runs);
  appendNever(out, runs.rungs);
  out += "</section>\n";
}

// The page of a program with a drawing.

constexpr size_t kTableRows = 100;
constexpr size_t kGroup = 40;
constexpr int kHeading = 60;
constexpr int kPieceHeight = 800; // pixels; higher drawings may be divided at the end of a page, between rows

class Page {
public:
  Page(const Program& program, const PageOptions& options)
      : program_(program), options_(options), rail_(commonRail(program)) {}
  std::string run();

private:
  std::string style() const;
  void runs();
  void contents();
  size_t group(size_t first);
  void block(const Block& block, size_t index);
  void heading(int level, const Block& block, size_t index);
  void place(const Place& place);
  void links(const std::vector<uint32_t>& rungs);
  void figure(const Figure& figure);
  void chart(const Chart& chart);
  void pieces(const Picture& picture, const std::string& name);
  void table(const NameTable& table, size_t index);
  void row(const NameRow& row, bool uses);
  void uses(const NameRow& row, bool writes);

  const Program& program_;
  const PageOptions& options_;
  int rail_;
  double hottest_ = 0;
  int height_ = 0;   // of the current group
  std::string file_; // CSS rule that names the pages of its file
  std::string out_;
};

// The name of each file is at the foot of its pages.
std::string Page::style() const {
  std::string style = fmt::format("figcaption {{ max-width: {}px; }}\n", rail_ + kMargin);
  if (program_.files.size() == 1)
    put(style, "@page {{ @bottom-center {{ content: {}; }} }}\n", cssText(program_.files[0].name));
  for (const Block& block : program_.blocks)
    if (block.kind == Block::Kind::File)
      put(style, "@page f{} {{ @bottom-center {{ content: {}; }} }}\n", block.place.file, cssText(block.text));
  return style;
}

void Page::runs() {
  RunsOnPage runs{&program_.runs, {}, false};
  for (const Figure& figure : program_.figures) {
    runs.rungs.push_back({figure.number, figure.title, &figure.run});
    for (const Cell& cell : figure.sheet.cells) runs.elements = runs.elements || cell.seen != Seen::Unasked;
  }
  hottest_ = hottest(runs.rungs);
  appendRuns(out_, runs);
}

void Page::contents() {
  out_ += "<nav aria-label=\"Contents\"><h2>Contents</h2><ul>\n";
  for (const ContentsEntry& entry : contentsOf(program_)) {
    put(out_, "<li class=\"c{}\"><a href=\"#b{}\">{}</a>", entry.level, entry.block, escaped(entry.text));
    if (!entry.title.empty()) put(out_, "<span>{}</span>", escaped(entry.title));
    if (entry.firstRung != 0 && entry.firstRung == entry.lastRung) put(out_, "<i>{}</i>", entry.firstRung);
    if (entry.firstRung != entry.lastRung) put(out_, "<i>{}\u2013{}</i>", entry.firstRung, entry.lastRung);
    out_ += "</li>\n";
  }
  for (size_t i = 0; i < program_.tables.size(); ++i)
    put(out_, "<li class=\"c0\"><a href=\"#t{}\">{}</a></li>\n", i, escaped(program_.tables[i].title));
  out_ += "</ul><p class=\"C\">Numbers are those of rungs. Below a contact, \u219012 is the rung that writes it; "
          "\u219012+2: two more rungs write it.</p></nav>\n";
}

void Page::place(const Place& place) {
  if (place.line > 0) appendPlace(out_, program_.files[place.file], place.line, options_);
}

void Page::heading(int level, const Block& block, size_t index) {
  height_ += kHeading;
  put(out_, "<h{} id=\"b{}\">{}{}{} ", level, index, escaped(block.text), block.title.empty() ? "" : ": ",
      escaped(block.title));
  place(block.place);
  put(out_, "</h{}>\n", level);
  if (!block.comment.empty()) put(out_, "<p class=\"C\">{}</p>\n", escaped(block.comment));
  if (block.callers.rungs.empty()) return;
  put(out_, "<p class=\"C\">{} ", block.callers.lead);
  links(block.callers.rungs);
  out_ += "</p>\n";
}

void Page::links(const std::vector<uint32_t>& rungs) {
  for (size_t i = 0; i < rungs.size(); ++i) put(out_, "{0}<a href=\"#r{1}\">{1}</a>", i == 0 ? "" : ", ", rungs[i]);
}

void Page::block(const Block& block, size_t index) {
  switch (block.kind) {
  case Block::Kind::File: return heading(2, block, index);
  case Block::Kind::Module: return heading(2, block, index);
  case Block::Kind::Section: return heading(3, block, index);
  case Block::Kind::Comment: {
    out_ += "<p class=\"C\">";
    for (char c : block.text) c == '\n' ? void(out_ += '\n') : appendEscaped(out_, std::string_view(&c, 1));
    out_ += "</p>\n";
    return;
  }
  case Block::Kind::Rung: return figure(program_.figures[block.figure]);
  case Block::Kind::Chart: return chart(program_.charts[block.figure]);
  }
}

void Page::figure(const Figure& figure) {
  const Picture picture = pictureOf(program_, figure, rail_);
  height_ += picture.height + 44 + static_cast<int>(figure.comments.size()) * 20;
  put(out_, "<figure class=\"R{}{}\" id=\"r{}\"><figcaption><b>{}</b>", picture.height > kPieceHeight ? " D" : "",
      classesOf(figure.run, hottest_), figure.number, figure.number);
  put(out_, "<span>{}</span>", escaped(captionOf(figure)));
  appendRun(out_, figure.run, hottest_);
  place(figure.place);
  out_ += "</figcaption>";
  for (const std::string& comment : figure.comments) put(out_, "<p>{}</p>", escaped(comment));
  pieces(picture, escaped(nameOf(figure)));
  out_ += "</figure>\n";
}

// `name` is escaped.
void Page::pieces(const Picture& picture, const std::string& name) {
  for (const Picture& piece : piecesOf(picture, kPieceHeight)) {
    put(out_, "<svg role=\"img\" aria-label=\"{0}\" width=\"{1}\" height=\"{2}\" viewBox=\"0 {3} {1} {2}\">", name,
        piece.width, piece.height, piece.top);
    appendPicture(out_, piece, true);
    out_ += "</svg>";
  }
}

// Of a module, which has no rung for it.
void Page::chart(const Chart& chart) {
  const Picture picture = layOut(chart);
  height_ += picture.height + 20;
  put(out_, "<figure class=\"R{}\">", picture.height > kPieceHeight ? " D" : "");
  pieces(picture, escaped(chart.sequence.name));
  out_ += "</figure>\n";
}

// The rungs that write or read a name; if there are none, the machine or NC that does.
void Page::uses(const NameRow& row, bool writes) {
  std::vector<uint32_t> rungs;
  for (const Use& use : row.uses)
    if (use.writes == writes) rungs.push_back(use.rung);
  out_ += "<td>";
  links(rungs);
  const bool machine = writes ? row.input : row.output;
  const bool indexed = row.key.find_first_of(",:") != std::string::npos; // it may be any place
  if (rungs.empty() && !row.key.empty() && !indexed) out_ += machine ? "<i>machine</i>" : "<i class=\"g\">never</i>";
  out_ += "</td>";
}

void Page::row(const NameRow& row, bool withWrites) {
  if (row.name.empty()) {
    put(out_, "<tr><td class=\"q\" colspan=\"5\">{}</td></tr>\n", escaped(row.comment));
    return;
  }
  put(out_, "<tr id=\"n{}\"><th scope=\"row\">{}</th><td class=\"v\">{}</td><td>{}</td>", row.id, escaped(row.name),
      escaped(row.address), escaped(row.comment));
  if (withWrites && row.constant)
    out_ += "<td></td>";
  else if (withWrites)
    uses(row, true);
  uses(row, false);
  out_ += "</tr>\n";
}

// Several tables with the same columns, so that a browser lays out only the visible ones.
void Page::table(const NameTable& table, size_t index) {
  put(out_, "<h2 id=\"t{}\">{}</h2>\n", index, escaped(table.title));
  if (!table.texts)
    out_ +=
        "<p class=\"C\">\u201cnever\u201d: no rung uses this name or address directly; block and indexed instructions "
        "may. Indexed ones are not listed here, nor at contacts and coils; <code>rungc xref</code> names them.</p>\n";
  for (size_t first = 0; first < table.rows.size(); first += kTableRows) {
    const auto rows = std::span(table.rows).subspan(first, std::min(kTableRows, table.rows.size() - first));
    put(out_, "<div class=\"T{}\" style=\"contain-intrinsic-size:auto 1100px auto {}px\"><table><thead><tr>",
        table.texts ? " V" : "", (rows.size() + 1) * 25);
    out_ += table.texts ? "<th>Number</th><th>Text</th><th>Comment</th><th>Shown in rung</th>"
                        : "<th>Name</th><th>Address</th><th>Comment</th><th>Written in rung</th><th>Read in rung</th>";
    out_ += "</tr></thead><tbody>\n";
    for (const NameRow& one : rows) row(one, !table.texts);
    out_ += "</tbody></table></div>\n";
  }
}

// Blocks that a browser lays out when they become visible; their height must be known before. A file begins a new
// group: on paper it begins a page. Returns the end of the group.
size_t Page::group(size_t first) {
  std::string before = std::exchange(out_, {});
  height_ = 0;
  if (program_.blocks[first].kind == Block::Kind::File)
    file_ = fmt::format("page:f{};", program_.blocks[first].place.file);
  size_t i = first;
  do {
    block(program_.blocks[i], i);
    ++i;
  } while (i < program_.blocks.size() && i < first + kGroup && program_.blocks[i].kind != Block::Kind::File);
  put(before, "<div class=\"G\" style=\"{}contain-intrinsic-size:auto 1000px auto {}px\">\n{}</div>\n", file_, height_,
      out_);
  out_ = std::move(before);
  return i;
}

std::string Page::run() {
  runs();
  contents();
  out_ += "<main>\n";
  for (size_t first = 0; first < program_.blocks.size();) first = group(first);
  for (size_t i = 0; i < program_.tables.size(); ++i) table(program_.tables[i], i);
  out_ += "</main>\n";
  return wholePage({program_.title, program_.control, program_.figures.size(), pictureStyle(program_, true), style()},
                   options_, out_);
}

} // namespace

std::string renderHtml(const Program& program, const PageOptions& options) { return Page(program, options).run(); }

} // namespace rung::view
