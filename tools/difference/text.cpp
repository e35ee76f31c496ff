// A difference for people (see difference.h).
#include <algorithm>
#include <fmt/format.h>
#include <string_view>

#include "ir/support/put.h"
#include "tools/difference/difference.h"

namespace rung::difference {
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
  put(out, "{} {}", nameOf(change.kind),
      change.before != nullptr ? placeOf(before, *change.before) : placeOf(after, *change.after));
  if (change.before != nullptr && change.after != nullptr) put(out, " to {}", placeOf(after, *change.after));
  out += '\n';
  if (change.kind == ChangeKind::Moved) return;
  if (change.before != nullptr) addLines(*change.before, '-', out);
  if (change.after != nullptr) addLines(*change.after, '+', out);
}

void addNames(const std::vector<NameChange>& changes, std::string_view what, std::string& out) {
  for (const NameChange& change : changes) {
    put(out, "{} {} {}: {}", nameOf(change.kind), what, change.name,
        change.kind == ChangeKind::Added ? change.after : change.before);
    if (change.kind == ChangeKind::Changed) put(out, " to {}", change.after);
    out += '\n';
  }
}

} // namespace

std::string shownAsText(const Difference& difference, const Module& before, const Module& after) {
  std::string out;
  for (const RungChange& change : difference.rungs) addRung(change, before, after, out);
  addNames(difference.names, "name", out);
  addNames(difference.messages, "message", out);
  size_t counts[4] = {};
  for (const RungChange& change : difference.rungs) ++counts[static_cast<int>(change.kind)];
  put(out, "rungs: {} changed, {} added, {} removed, {} moved, {} the same\n", counts[2], counts[0], counts[1],
      counts[3], difference.same);
  return out;
}

} // namespace rung::difference
