// The page (see html.h).
#include "tools/view/html.h"

#include <algorithm>
#include <span>
#include <utility>

#include "ir/support/put.h"
#include "tools/view/html_page.h"
#include "tools/view/html_runs.h"
#include "tools/view/layout.h"
#include "tools/view/pieces.h"
#include "tools/view/program.h"
#include "tools/view/svg.h"

namespace rung::view {
namespace {

constexpr size_t kTableRows = 100;
constexpr size_t kGroup = 40;
constexpr int kHeading = 60;
constexpr int kPieceHeight = 800; // higher drawings may be torn by the end of a page, between rows

class Page {
public:
  Page(const Program& program, const PageOptions& options)
      : program_(program), options_(options), rail_(commonRail(program)) {}
  std::string run();

private:
  void head();
  void runs();
  void contents();
  size_t group(size_t first);
  void block(const Block& block, size_t index);
  void heading(int level, const Block& block, size_t index);
  void place(const Place& place);
  void links(const std::vector<uint32_t>& rungs);
  void figure(const Figure& figure);
  void table(const NameTable& table, size_t index);
  void row(const NameRow& row, bool uses);
  void uses(const NameRow& row, bool writes);

  const Program& program_;
  const PageOptions& options_;
  int rail_;
  double hottest_ = 0;
  int height_ = 0;   // of the current group
  std::string file_; // rule of style that names the pages of its file
  std::string out_;
};

// Every file has its name at the foot of its pages.
void Page::head() {
  std::string style = fmt::format("figcaption{{max-width:{}px}}\n", rail_ + kMargin);
  if (program_.files.size() == 1)
    put(style, "@page{{@bottom-center{{content:{}}}}}\n", cssText(program_.files[0].name));
  for (const Block& block : program_.blocks)
    if (block.kind == Block::Kind::File)
      put(style, "@page f{}{{@bottom-center{{content:{}}}}}\n", block.place.file, cssText(block.text));
  beginPage(out_, {program_.title, program_.control, program_.figures.size(), style}, options_);
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
  }
}

void Page::figure(const Figure& figure) {
  const Picture picture = layOut(figure.sheet, rail_);
  height_ += picture.height + 44 + static_cast<int>(figure.comments.size()) * 20;
  put(out_, "<figure class=\"R{}{}\" id=\"r{}\"><figcaption><b>{}</b>", picture.height > kPieceHeight ? " D" : "",
      classesOf(figure.run, hottest_), figure.number, figure.number);
  put(out_, "<span>{}</span>", escaped(figure.title));
  appendRun(out_, figure.run, hottest_);
  place(figure.place);
  out_ += "</figcaption>";
  for (const std::string& comment : figure.comments) put(out_, "<p>{}</p>", escaped(comment));
  const std::string name = escaped(nameOf(figure));
  for (const Picture& piece : piecesOf(picture, kPieceHeight)) {
    put(out_, "<svg role=\"img\" aria-label=\"{0}\" width=\"{1}\" height=\"{2}\" viewBox=\"0 {3} {1} {2}\">", name,
        piece.width, piece.height, piece.top);
    appendPicture(out_, piece, true);
    out_ += "</svg>";
  }
  out_ += "</figure>\n";
}

// The rungs that write or read a name; where there are none, who does.
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

// Several tables of the same columns, so that a browser lays out the visible ones only.
void Page::table(const NameTable& table, size_t index) {
  put(out_, "<h2 id=\"t{}\">{}</h2>\n", index, escaped(table.title));
  if (!table.texts)
    out_ +=
        "<p class=\"C\">\u201cnever\u201d: no rung uses this name or address directly; block and indexed instructions "
        "may.</p>\n";
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

// Blocks that a browser lays out when they become visible; their height must be known before. A file begins a group of
// its own: on paper it begins a page. Gives the end of the group.
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
  head();
  runs();
  contents();
  out_ += "<main>\n";
  for (size_t first = 0; first < program_.blocks.size();) first = group(first);
  for (size_t i = 0; i < program_.tables.size(); ++i) table(program_.tables[i], i);
  out_ += "</main>\n";
  endPage(out_);
  return std::move(out_);
}

} // namespace

std::string renderHtml(const Program& program, const PageOptions& options) { return Page(program, options).run(); }

} // namespace rung::view
