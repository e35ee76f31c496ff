// The page of a program that has no drawing: the lines of its source by rung (see overlay.h).
#include <algorithm>
#include <map>

#include "ir/support/put.h"
#include "rtlib/text/blanks.h"
#include "tools/view/html_page.h"
#include "tools/view/html_runs.h"
#include "tools/view/overlay.h"
#include "tools/view/svg.h"

namespace rung::view {
namespace {

using FileLine = std::pair<std::string_view, uint32_t>;

std::string withoutTabs(std::string_view line) {
  constexpr size_t kTab = 8;
  std::string text;
  for (const char c : line) c == '\t' ? text.append(kTab - text.size() % kTab, ' ') : text += c;
  return text;
}

class TablePage {
public:
  TablePage(const Listing& listing, const Overlay& overlay, const PageOptions& options)
      : listing_(listing), overlay_(overlay), options_(options) {
    for (const RungOverlay& rung : overlay.rungs) {
      if (rung.number != 0)
        byNumber_.emplace(rung.number, &rung.run);
      else
        byPlace_.emplace(FileLine{rung.place.file, rung.place.line}, &rung.run);
    }
    for (const ElementOverlay& element : overlay.elements)
      elements_.emplace(FileLine{element.place.file, element.place.line}, &element);
    for (size_t i = 0; i < listing.rows.size(); ++i) lastOf_[listing.rows[i].place.file] = i;
  }
  std::string run();

private:
  bool hasRuns() const { return !overlay_.title.empty(); }
  const Run& runOf(const TableRow& row) const;
  std::string missingIn(const TableRow& row) const;
  void lines(std::string_view file, uint32_t first, uint32_t last);
  void linesBetween(const std::string& file, uint32_t end);
  void contents();
  void head(std::string_view title, size_t index);
  void row(const TableRow& row);
  void filesWithoutRungs();

  const Listing& listing_;
  const Overlay& overlay_;
  const PageOptions& options_;
  std::map<uint32_t, const Run*> byNumber_;
  std::map<FileLine, const Run*> byPlace_;
  std::multimap<FileLine, const ElementOverlay*> elements_;
  std::map<std::string_view, size_t> lastOf_;  // the last row of each file
  std::map<std::string_view, uint32_t> shown_; // of each file: up to this line
  double hottest_ = 0;
  std::string out_;
};

const Run& TablePage::runOf(const TableRow& row) const {
  static const Run kNothing;
  if (const auto at = byNumber_.find(row.number); at != byNumber_.end()) return *at->second;
  const auto at = byPlace_.find({row.place.file, row.place.line});
  return at == byPlace_.end() ? kNothing : *at->second;
}

// "14 never closed, 16 never on": by line.
std::string TablePage::missingIn(const TableRow& row) const {
  std::string text;
  auto at = elements_.lower_bound({row.place.file, row.place.line});
  const auto end = elements_.upper_bound({row.place.file, std::max(row.place.line, row.lastLine)});
  for (; at != end; ++at) {
    const std::string badge = badgeOf(*at->second);
    if (badge.empty()) continue;
    put(text, "{}<span title=\"{}\">line {} {}</span>", text.empty() ? "" : "<br>", escaped(at->second->detail),
        at->second->place.line, badge);
  }
  return text;
}

// Lines of the source, as far as it is there.
void TablePage::lines(std::string_view file, uint32_t first, uint32_t last) {
  const auto text = listing_.texts.find(std::string(file));
  if (text == listing_.texts.end() || first == 0) return;
  out_ += "<pre>";
  for (uint32_t line = first; line <= std::min<size_t>(last, text->second.size()); ++line)
    put(out_, "<i>{}</i>{}\n", line, escaped(withoutTabs(text->second[line - 1])));
  out_ += "</pre>";
}

// What has not been shown yet before line `end`: remarks, declarations, the beginnings and ends of modules.
void TablePage::linesBetween(const std::string& file, uint32_t end) {
  const auto text = listing_.texts.find(file);
  if (text == listing_.texts.end()) return;
  uint32_t first = shown_[file] + 1;
  uint32_t last = std::min<uint32_t>(end, static_cast<uint32_t>(text->second.size()) + 1) - 1;
  const auto isBlank = [&](uint32_t line) { return text::trimmed(text->second[line - 1]).empty(); };
  while (first <= last && isBlank(first)) ++first;
  while (first <= last && isBlank(last)) --last;
  if (first > last) return;
  put(out_, "<tr><td class=\"b\" colspan=\"{}\">", hasRuns() ? 4 : 2);
  lines(file, first, last);
  out_ += "</td></tr>\n";
}

void TablePage::row(const TableRow& row) {
  const Run& run = runOf(row);
  linesBetween(row.place.file, row.place.line);
  uint32_t& shown = shown_[row.place.file];
  shown = std::max({shown, row.place.line, row.lastLine});
  put(out_, "<tr class=\"Q{0}\" id=\"r{1}\"><th scope=\"row\">{1}</th><td>", classesOf(run, hottest_), row.number);
  if (!row.title.empty()) put(out_, "<b>{}</b> ", escaped(row.title));
  const std::string& path = row.place.file;
  appendPlace(out_, {path, path.substr(path.find_last_of('/') + 1)}, row.place.line, options_);
  lines(path, row.place.line, std::max(row.place.line, row.lastLine));
  out_ += "</td>";
  if (hasRuns()) {
    out_ += "<td>";
    appendRun(out_, run, hottest_);
    put(out_, "</td><td class=\"g\">{}</td>", missingIn(row));
  }
  out_ += "</tr>\n";
}

// The routines with their rungs.
void TablePage::contents() {
  const std::vector<TableRow>& rows = listing_.rows;
  out_ += "<nav aria-label=\"Contents\"><h2>Contents</h2><ul>\n";
  for (size_t first = 0, end = 0; first < rows.size(); first = end) {
    while (end < rows.size() && rows[end].routine == rows[first].routine) ++end;
    put(out_, "<li class=\"c0\"><a href=\"#m{}\">{}</a><i>{}", first, escaped(rows[first].routine), rows[first].number);
    if (end - first > 1) put(out_, "\u2013{}", rows[end - 1].number);
    out_ += "</i></li>\n";
  }
  out_ += "</ul><p class=\"C\">Numbers are those of rungs.</p></nav>\n";
}

void TablePage::head(std::string_view title, size_t index) {
  put(out_, "<h3 id=\"m{}\">{}</h3>\n<table class=\"{}\"><thead><tr><th>Rung</th><th>Source</th>", index,
      escaped(title), hasRuns() ? "Y" : "Y L");
  if (hasRuns()) out_ += "<th>Run</th><th>Not seen</th>";
  out_ += "</tr></thead><tbody>\n";
}

// They declare what the others use.
void TablePage::filesWithoutRungs() {
  size_t index = listing_.rows.size();
  for (const auto& [path, text] : listing_.texts) {
    if (lastOf_.contains(path)) continue;
    head(path.substr(path.find_last_of('/') + 1), index++);
    linesBetween(path, UINT32_MAX);
    out_ += "</tbody></table>\n";
  }
}

std::string TablePage::run() {
  const RunSummary summary{overlay_.title, overlay_.summary, overlay_.heat};
  const std::vector<TableRow>& rows = listing_.rows;
  RunsOnPage runs{&summary, {}, !overlay_.elements.empty()};
  for (const TableRow& row : rows) runs.rungs.push_back({row.number, row.title, &runOf(row)});
  hottest_ = hottest(runs.rungs);
  beginPage(out_, {listing_.title, listing_.control, rows.size(), ""}, options_);
  appendRuns(out_, runs);
  contents();
  out_ += "<main>\n";
  for (size_t i = 0; i < rows.size(); ++i) {
    if (i == 0 || rows[i].routine != rows[i - 1].routine) {
      if (i > 0) out_ += "</tbody></table>\n";
      head(rows[i].routine, i);
    }
    row(rows[i]);
    if (lastOf_[rows[i].place.file] == i) linesBetween(rows[i].place.file, UINT32_MAX);
  }
  if (!rows.empty()) out_ += "</tbody></table>\n";
  filesWithoutRungs();
  out_ += "</main>\n";
  endPage(out_);
  return std::move(out_);
}

} // namespace

std::string renderTable(const Listing& listing, const Overlay& overlay, const PageOptions& options) {
  return TablePage(listing, overlay, options).run();
}

} // namespace rung::view
