// The page of a program that has no drawing: its rungs as rows (see overlay.h).
#include <algorithm>
#include <map>

#include "ir/support/put.h"
#include "tools/view/html_page.h"
#include "tools/view/html_runs.h"
#include "tools/view/overlay.h"
#include "tools/view/svg.h"

namespace rung::view {
namespace {

using FileLine = std::pair<std::string_view, uint32_t>;

class TablePage {
public:
  TablePage(std::span<const TableRow> rows, const Overlay& overlay, const PageOptions& options)
      : rows_(rows), overlay_(overlay), options_(options) {
    for (const RungOverlay& rung : overlay.rungs) {
      if (rung.number != 0)
        byNumber_.emplace(rung.number, &rung.run);
      else
        byPlace_.emplace(FileLine{rung.place.file, rung.place.line}, &rung.run);
    }
    for (const ElementOverlay& element : overlay.elements)
      elements_.emplace(FileLine{element.place.file, element.place.line}, &element);
  }
  std::string run(std::string_view title, std::string_view control);

private:
  const Run& runOf(const TableRow& row) const;
  std::string missingIn(const TableRow& row) const;
  void row(const TableRow& row);

  std::span<const TableRow> rows_;
  const Overlay& overlay_;
  const PageOptions& options_;
  std::map<uint32_t, const Run*> byNumber_;
  std::map<FileLine, const Run*> byPlace_;
  std::multimap<FileLine, const ElementOverlay*> elements_;
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

void TablePage::row(const TableRow& row) {
  const Run& run = runOf(row);
  put(out_, "<tr class=\"Q{0}\" id=\"r{1}\"><th scope=\"row\">{1}</th><td>{2}</td><td>", classesOf(run, hottest_),
      row.number, escaped(row.title));
  const std::string& path = row.place.file;
  appendPlace(out_, {path, path.substr(path.find_last_of('/') + 1)}, row.place.line, options_);
  out_ += "</td><td>";
  appendRun(out_, run, hottest_);
  put(out_, "</td><td class=\"g\">{}</td></tr>\n", missingIn(row));
}

std::string TablePage::run(std::string_view title, std::string_view control) {
  const RunSummary summary{overlay_.title, overlay_.summary, overlay_.heat};
  RunsOnPage runs{&summary, {}, !overlay_.elements.empty()};
  for (const TableRow& row : rows_) runs.rungs.push_back({row.number, row.title, &runOf(row)});
  hottest_ = hottest(runs.rungs);
  beginPage(out_, {title, control, rows_.size(), ""}, options_);
  appendRuns(out_, runs);
  out_ += "<main>\n";
  for (size_t i = 0; i < rows_.size(); ++i) {
    if (i == 0 || rows_[i].routine != rows_[i - 1].routine) {
      if (i > 0) out_ += "</tbody></table>\n";
      put(out_, "<h3>{}</h3>\n<table class=\"Y\"><thead><tr><th>Rung</th><th>Title</th><th>Source</th>",
          escaped(rows_[i].routine));
      out_ += "<th>Run</th><th>Not seen</th></tr></thead><tbody>\n";
    }
    row(rows_[i]);
  }
  if (!rows_.empty()) out_ += "</tbody></table>\n";
  out_ += "</main>\n";
  endPage(out_);
  return std::move(out_);
}

} // namespace

std::string renderTable(std::string_view title, std::string_view control, std::span<const TableRow> rows,
                        const Overlay& overlay, const PageOptions& options) {
  return TablePage(rows, overlay, options).run(title, control);
}

} // namespace rung::view
