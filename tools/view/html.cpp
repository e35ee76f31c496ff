// The page (see html.h).
#include "tools/view/html.h"

#include <algorithm>
#include <span>
#include <utility>

#include "tools/view/html_page.h"
#include "tools/view/html_runs.h"
#include "tools/view/layout.h"
#include "tools/view/pieces.h"
#include "tools/view/put.h"
#include "tools/view/svg.h"

namespace rung::view {
namespace {

constexpr size_t kTableRows = 100;
constexpr size_t kGroup = 40;
constexpr int kHeading = 60;
constexpr int kPieceHeight = 800; // higher drawings may be torn by the end of a page, between rows

class Page {
public:
  explicit Page(const Program& program) : program_(program), rail_(commonRail(program)) {}
  std::string run();

private:
  void head();
  void runs();
  void contents();
  void group(size_t first);
  void block(const Block& block, size_t index);
  void heading(int level, const Block& block, size_t index, std::string_view prefix);
  void figure(const Figure& figure);
  void table(const NameTable& table, size_t index);
  void row(const NameRow& row, bool uses);
  void uses(const NameRow& row, bool writes);

  const Program& program_;
  int rail_;
  double hottest_ = 0;
  size_t rows_ = 0;
  int height_ = 0; // of the group at hand
  std::string out_;
};

void Page::head() {
  beginPage(out_, program_.title, fmt::format("figcaption{{max-width:{}px}}", rail_ + kMargin));
  put(out_, "<p>{}, {} rung{}</p>\n", escaped(program_.control), program_.figures.size(),
      program_.figures.size() == 1 ? "" : "s");
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
  out_ += "<nav aria-label=\"Contents\"><ul>\n";
  for (size_t i = 0; i < program_.blocks.size(); ++i) {
    const Block& block = program_.blocks[i];
    const bool module = block.kind == Block::Kind::Module;
    if (module || block.kind == Block::Kind::Section)
      put(out_, "<li><a href=\"#b{}\">{}{}</a></li>\n", i, module ? "Module " : "", escaped(block.text));
  }
  for (size_t i = 0; i < program_.tables.size(); ++i)
    put(out_, "<li><a href=\"#t{}\">{}</a></li>\n", i, escaped(program_.tables[i].title));
  out_ += "</ul></nav>\n";
}

void Page::heading(int level, const Block& block, size_t index, std::string_view prefix) {
  height_ += kHeading;
  put(out_, "<h{} id=\"b{}\">{}{}", level, index, prefix, escaped(block.text));
  const std::string place = textOf(program_, block.place);
  if (!place.empty()) put(out_, " <small>{}</small>", escaped(place));
  put(out_, "</h{}>\n", level);
  if (!block.comment.empty()) put(out_, "<p class=\"C\">{}</p>\n", escaped(block.comment));
}

void Page::block(const Block& block, size_t index) {
  switch (block.kind) {
  case Block::Kind::File: return heading(2, block, index, "");
  case Block::Kind::Module: return heading(2, block, index, "Module ");
  case Block::Kind::Section: return heading(3, block, index, "");
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
  put(out_, "<i class=\"f\">{}</i></figcaption>", escaped(textOf(program_, figure.place)));
  for (const std::string& comment : figure.comments) put(out_, "<p>{}</p>", escaped(comment));
  const std::string name = escaped(nameOf(figure));
  for (const Picture& piece : piecesOf(picture, kPieceHeight)) {
    put(out_, "<svg role=\"img\" aria-label=\"{0}\" width=\"{1}\" height=\"{2}\" viewBox=\"0 {3} {1} {2}\">", name,
        piece.width, piece.height, piece.top);
    appendPicture(out_, piece);
    out_ += "</svg>";
  }
  out_ += "</figure>\n";
}

void Page::uses(const NameRow& row, bool writes) {
  out_ += "<td>";
  bool first = true;
  for (const Use& use : row.uses) {
    if (use.writes != writes) continue;
    put(out_, "{}<a href=\"#r{}\">{}</a>", first ? "" : ", ", use.rung, use.rung);
    first = false;
  }
  out_ += "</td>";
}

void Page::row(const NameRow& row, bool withWrites) {
  if (row.name.empty()) {
    put(out_, "<tr><td class=\"q\" colspan=\"5\">{}</td></tr>\n", escaped(row.comment));
    return;
  }
  put(out_, "<tr id=\"n{}\"><th scope=\"row\">{}</th><td class=\"v\">{}</td><td>{}</td>", rows_++, escaped(row.name),
      escaped(row.address), escaped(row.comment));
  if (withWrites) uses(row, true);
  uses(row, false);
  out_ += "</tr>\n";
}

// Several tables of the same columns, so that a browser lays out those in sight only.
void Page::table(const NameTable& table, size_t index) {
  put(out_, "<h2 id=\"t{}\">{}</h2>\n", index, escaped(table.title));
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

// Blocks that a browser lays out when they come in sight; their height must be known before.
void Page::group(size_t first) {
  std::string before = std::exchange(out_, {});
  height_ = 0;
  for (size_t i = first; i < std::min(first + kGroup, program_.blocks.size()); ++i) block(program_.blocks[i], i);
  put(before, "<div class=\"G\" style=\"contain-intrinsic-size:auto 1000px auto {}px\">\n{}</div>\n", height_, out_);
  out_ = std::move(before);
}

std::string Page::run() {
  head();
  runs();
  contents();
  out_ += "<main>\n";
  for (size_t first = 0; first < program_.blocks.size(); first += kGroup) group(first);
  for (size_t i = 0; i < program_.tables.size(); ++i) table(program_.tables[i], i);
  out_ += "</main>\n";
  endPage(out_);
  return std::move(out_);
}

} // namespace

std::string renderHtml(const Program& program) { return Page(program).run(); }

} // namespace rung::view
