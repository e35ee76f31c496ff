// See html_runs.h.
#include "tools/view/html_runs.h"

#include <algorithm>

#include "ir/support/put.h"
#include "tools/view/overlay.h"
#include "tools/view/svg.h"

namespace rung::view {
namespace {

constexpr size_t kListed = 10; // of the rungs that take most
constexpr int kBar = 90;       // pixels of the longest bar

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

// "4, 8–12": a link to the first of neighbours.
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

} // namespace

double hottest(const std::vector<RunRow>& rungs) {
  double most = 0;
  for (const RunRow& row : rungs) most = std::max(most, row.run->heat);
  return most;
}

std::string classesOf(const Run& run, double hottest) {
  if (run.state == Run::State::Never) return " N";
  return run.state == Run::State::Ran ? fmt::format(" H{}", heatStep(run, hottest)) : "";
}

void appendRun(std::string& out, const Run& run, double hottest) {
  if (run.state == Run::State::Unasked) return;
  put(out, "<i class=\"o\"");
  if (!run.detail.empty()) put(out, " title=\"{}\"", escaped(run.detail));
  out += ">";
  const int bar = run.heat > 0 ? std::max(1, static_cast<int>(run.heat / hottest * kBar)) : 0;
  if (bar > 0) put(out, "<s class=\"s{}\" style=\"width:{}px\"></s>", heatStep(run, hottest), bar);
  put(out, "{}</i>", escaped(labelOf(run)));
}

void appendRuns(std::string& out, const RunsOnPage& runs) {
  if (runs.summary->title.empty()) return;
  put(out, "<section id=\"run\" aria-label=\"{0}\"><h2>{0}</h2>\n", escaped(runs.summary->title));
  for (const std::string& line : runs.summary->lines) put(out, "<p>{}</p>\n", escaped(line));
  appendLegend(out, runs);
  appendMost(out, runs);
  appendNever(out, runs.rungs);
  out += "</section>\n";
}

} // namespace rung::view
