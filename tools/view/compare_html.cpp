// The page of two versions (see compare_html.h).
#include "tools/view/compare_html.h"

#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "ir/support/put.h"
#include "tools/view/layout.h"
#include "tools/view/style.h"
#include "tools/view/svg.h"

namespace rung::view {
namespace {

constexpr int kRail = 520; // x of the right rail: two drawings fit beside each other
constexpr std::string_view kStates[] = {"same", "added", "removed", "changed", "moved"}; // indexed by State

// All that an element says, without its place.
std::string contentOf(const Cell& cell) {
  std::string text =
      fmt::format("{}\n{}\n{}\n{}", static_cast<int>(cell.kind), cell.mark, cell.title, cell.operand.name);
  for (const Operand& operand : cell.operands) put(text, "\n{}", operand.name);
  return text;
}

bool isElement(const Cell& cell) { return cell.kind != Cell::Kind::Rail && cell.kind != Cell::Kind::Joint; }

std::vector<Cell*> elementsOf(Sheet& sheet) {
  std::vector<Cell*> elements;
  for (Cell& cell : sheet.cells)
    if (isElement(cell)) elements.push_back(&cell);
  return elements;
}

// Marks the elements that are not in a longest sequence of equal ones.
void markDifferent(Sheet& before, Sheet& after) {
  const std::vector<Cell*> a = elementsOf(before), b = elementsOf(after);
  std::vector<std::vector<uint32_t>> equal(a.size() + 1, std::vector<uint32_t>(b.size() + 1, 0)); // from there on
  for (size_t i = a.size(); i-- > 0;)
    for (size_t j = b.size(); j-- > 0;)
      equal[i][j] =
          contentOf(*a[i]) == contentOf(*b[j]) ? equal[i + 1][j + 1] + 1 : std::max(equal[i + 1][j], equal[i][j + 1]);
  const auto mark = [](Cell& cell, std::string_view what) {
    cell.seen = Seen::Part;
    cell.detail = what;
  };
  size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && contentOf(*a[i]) == contentOf(*b[j])) {
      ++i, ++j;
    } else if (j == b.size() || (i < a.size() && equal[i + 1][j] >= equal[i][j + 1])) {
      mark(*a[i++], "only in the older version");
    } else {
      mark(*b[j++], "only in the newer version");
    }
  }
}

class ComparisonPage {
public:
  ComparisonPage(Program& before, Program& after, const Comparison& comparison)
      : before_(before), after_(after), comparison_(comparison) {
    for (Figure& figure : before_.figures) olds_.emplace(figure.number, &figure);
    for (Figure& figure : after_.figures) news_.emplace(figure.number, &figure);
  }

  std::string run() {
    const std::span<const ComparedRung> rungs = comparison_.rungs;
    head();
    for (const ComparedTable& table : comparison_.tables) list(table);
    for (size_t i = 0; i < rungs.size();) {
      size_t end = i;
      while (end < rungs.size() && rungs[end].state == ComparedRung::State::Same) ++end;
      if (end > i)
        folded(rungs.subspan(i, end - i));
      else
        pair(rungs[end++]);
      i = end;
    }
    out_ += "</main></body></html>\n";
    return std::move(out_);
  }

private:
  void head() {
    put(out_,
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>{} → "
        "{}</title>\n<style>\n{}{}{}</style></head><body>\n",
        escaped(comparison_.before), escaped(comparison_.after), colourRules(),
        pictureStyle(after_.charts.empty() ? before_ : after_, true), text::textOf(pageFiles(), "compare.css"));
    put(out_, "<header><h1>{} <span>→</span> {}</h1><p>{}</p></header>\n<main>\n", escaped(comparison_.before),
        escaped(comparison_.after), summary());
    put(out_, "<div class=\"pair heads\"><h2>{}</h2><h2>{}</h2></div>\n", escaped(comparison_.before),
        escaped(comparison_.after));
  }

  std::string summary() const {
    std::string text;
    for (const auto state : {ComparedRung::State::Changed, ComparedRung::State::Added, ComparedRung::State::Removed,
                             ComparedRung::State::Moved, ComparedRung::State::Same}) {
      const auto count = std::ranges::count(comparison_.rungs, state, &ComparedRung::state);
      if (count == 0) continue;
      const std::string_view name = kStates[static_cast<size_t>(state)];
      put(text, "{}<b class=\"is-{}\">{}</b> {}", text.empty() ? "" : ", ", name, count,
          state == ComparedRung::State::Same ? "unchanged" : name);
    }
    return "Rungs: " + text;
  }

  void list(const ComparedTable& table) {
    if (table.rows.empty()) return;
    put(out_,
        "<table><caption>{}</caption><thead><tr><th scope=\"col\"></th><th scope=\"col\">Name</th><th "
        "scope=\"col\">Before</th><th scope=\"col\">After</th></tr></thead><tbody>\n",
        escaped(table.title));
    for (const ComparedTable::Row& row : table.rows)
      put(out_, "<tr><td class=\"is-{0}\">{0}</td><th scope=\"row\">{1}</th><td>{2}</td><td>{3}</td></tr>\n", row.what,
          escaped(row.name), escaped(row.before), escaped(row.after));
    out_ += "</tbody></table>\n";
  }

  // Unchanged rungs: the newer version of each.
  void folded(std::span<const ComparedRung> rungs) {
    const ComparedRung& first = rungs.front();
    const ComparedRung& last = rungs.back();
    put(out_, "<details><summary>{} unchanged rung{}: {}</summary>\n", rungs.size(), rungs.size() == 1 ? "" : "s",
        rungs.size() == 1 ? std::to_string(first.after) : fmt::format("{} to {}", first.after, last.after));
    for (const ComparedRung& rung : rungs) side(after_, news_, rung.after);
    out_ += "</details>\n";
  }

  void pair(const ComparedRung& rung) {
    const auto state = kStates[static_cast<size_t>(rung.state)];
    const auto before = olds_.find(rung.before), after = news_.find(rung.after);
    if (rung.state == ComparedRung::State::Changed && before != olds_.end() && after != news_.end())
      markDifferent(before->second->sheet, after->second->sheet);
    put(out_, "<section class=\"is-{0}\" aria-label=\"{0}\"><p class=\"what\">{0}", state);
    for (const std::string& remark : rung.remarks) put(out_, "<span>{}</span>", escaped(remark));
    out_ += "</p><div class=\"pair\">";
    side(before_, olds_, rung.before);
    side(after_, news_, rung.after);
    out_ += "</div></section>\n";
  }

  using Figures = std::map<uint32_t, Figure*>;
  void side(const Program& program, const Figures& figures, uint32_t number) {
    const auto found = figures.find(number);
    if (found == figures.end()) {
      out_ += "<div class=\"none\"></div>";
      return;
    }
    const Figure& figure = *found->second;
    put(out_, "<article><h3><b>{}</b> {} <i>{}</i></h3>", figure.number, escaped(captionOf(figure)),
        escaped(textOf(program, figure.place)));
    for (const std::string& comment : figure.comments) put(out_, "<p>{}</p>", escaped(comment));
    const Picture picture = pictureOf(program, figure, kRail);
    put(out_, "<svg width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"{2}\">",
        picture.width, picture.height, escaped(nameOf(figure)));
    appendPicture(out_, picture, false);
    out_ += "</svg></article>";
  }

  Program& before_;
  Program& after_;
  const Comparison& comparison_;
  Figures olds_, news_; // by number
  std::string out_;
};

} // namespace

std::string renderComparison(Program before, Program after, const Comparison& comparison) {
  return ComparisonPage(before, after, comparison).run();
}

} // namespace rung::view
