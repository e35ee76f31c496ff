// A difference for people (see difference.h).
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>

#include "ir/support/put.h"
#include "tools/report/difference.h"

namespace rung::report {
namespace {

using ir::Module;
using ir::Rung;

std::string placeOf(const Module& module, const Rung& rung) {
  const std::string title = rung.title.empty() ? "" : fmt::format(" \"{}\"", rung.title);
  return fmt::format("rung {}{}, {}:{}", rung.number, title, module.files[rung.begin.file.index], rung.begin.line);
}

void addLines(const Rung& rung, char mark, std::string& out) {
  std::string_view text = rung.sourceText;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    put(out, "  {} {}\n", mark, text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void addRung(const RungChange& change, const Module& before, const Module& after, std::string& out) {
  const ShownRung &old = change.before, &now = change.after;
  put(out, "{} {}", nameOf(change.kind), old.rung != nullptr ? placeOf(before, *old.rung) : placeOf(after, *now.rung));
  if (old.rung != nullptr && now.rung != nullptr) {
    put(out, " to {}", placeOf(after, *now.rung));
    const std::string_view from = shownName(*old.routine), to = shownName(*now.routine);
    if (change.kind == ChangeKind::Moved && from != to) put(out, ", from {} to {}", from, to);
  }
  out += '\n';
  if (change.kind != ChangeKind::Moved) {
    if (old.rung != nullptr) addLines(*old.rung, '-', out);
    if (now.rung != nullptr) addLines(*now.rung, '+', out);
  }
  for (const OtherWay& way : change.ways) put(out, "  leads to {}, before: to {}\n", way.after, way.before);
}

void addNames(const std::vector<NameChange>& changes, std::string_view what, std::string& out) {
  for (const NameChange& change : changes) {
    put(out, "{} {}{}: {}", nameOf(change.kind), what, change.name,
        change.kind == ChangeKind::Added ? change.after : change.before);
    if (change.kind == ChangeKind::Changed) put(out, " to {}", change.after);
    out += '\n';
  }
}

// One that is not a message says itself what it is.
void addMessages(const std::vector<NameChange>& changes, std::string& out) {
  for (const NameChange& change : changes) {
    const bool isMessage = change.name.find_first_not_of("0123456789") == std::string::npos;
    addNames({change}, isMessage ? "message " : "", out);
  }
}

// "36 → 38, 40 → 42": what is unlike, or all where one version has more of them; the first ones of many.
std::string shownLines(const LineChange& change) {
  constexpr size_t kShown = 4;
  std::vector<std::string> parts;
  if (change.before.size() == change.after.size()) {
    for (size_t i = 0; i < change.after.size(); ++i)
      if (change.before[i] != change.after[i])
        parts.push_back(fmt::format("{} → {}", change.before[i], change.after[i]));
  } else {
    parts.push_back(fmt::format("{} → {}", fmt::join(change.before, ", "), fmt::join(change.after, ", ")));
  }
  const size_t shown = std::min(parts.size(), kShown);
  const std::string more = parts.size() > shown ? fmt::format(" and {} more", parts.size() - shown) : "";
  return fmt::format("{} {}{}", change.name,
                     fmt::join(parts.begin(), parts.begin() + static_cast<ptrdiff_t>(shown), ", "), more);
}

void addLineNumbers(const std::vector<LineChange>& changes, std::string& out) {
  if (changes.empty()) return;
  std::vector<std::string> parts;
  for (const LineChange& change : changes) parts.push_back(shownLines(change));
  put(out, "line numbers that the program reads have changed: {}\n", fmt::join(parts, "; "));
}

} // namespace

std::string_view shownName(const ir::Routine& routine) {
  const std::string_view name = routine.name;
  return name.substr(0, name.find('@', 1)); // of a unit that is there for each level that runs it
}

std::string shownAsText(const Difference& difference, const Module& before, const Module& after) {
  std::string out;
  for (const RungChange& change : difference.rungs) addRung(change, before, after, out);
  addNames(difference.names, "name ", out);
  addNames(difference.contents, "initial value ", out);
  addMessages(difference.messages, out);
  addNames(difference.settings, "configuration ", out);
  addLineNumbers(difference.lines, out);
  size_t counts[4] = {};
  for (const RungChange& change : difference.rungs) ++counts[static_cast<int>(change.kind)];
  put(out, "rungs: {} changed, {} added, {} removed, {} moved, {} unchanged\n", counts[2], counts[0], counts[1],
      counts[3], difference.same);
  return out;
}

} // namespace rung::report
