// The report of a replacement (see replace_report.h).
#include "tools/scenario/replace_report.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace rung::scenario {
namespace {

constexpr size_t kListed = 8; // changes in a message
constexpr char kCutNote[] = ": its new place has no room for all its contents, the rest is lost";

std::string counted(uint32_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string inWords(const std::string& name) {
  const bool plain = !name.starts_with('#') && name.find_first_of(" \t") == std::string::npos;
  return plain ? name : '"' + name + '"';
}

bool same(const runtime::StateChange& a, const runtime::StateChange& b) {
  return a.kind == b.kind && a.slot == b.slot && a.name == b.name && a.formerName == b.formerName;
}

std::string listOf(const std::vector<runtime::StateChange>& changes) {
  if (changes.empty()) return "none";
  std::string list;
  for (size_t i = 0; i < std::min(changes.size(), kListed); ++i) list += (i == 0 ? "" : ", ") + textOf(changes[i]);
  if (changes.size() > kListed) list += fmt::format(" and {} more", changes.size() - kListed);
  return list;
}

} // namespace

std::optional<runtime::ChangeKind> changeKindFromName(std::string_view name) {
  const auto* found = std::ranges::find(runtime::kChangeKinds, name);
  if (found == std::end(runtime::kChangeKinds)) return std::nullopt;
  return static_cast<runtime::ChangeKind>(found - std::begin(runtime::kChangeKinds));
}

std::string textOf(const runtime::StateChange& change) {
  std::string text(runtime::kChangeKinds[static_cast<size_t>(change.kind)]);
  if (change.slot) text.append(" ").append(kStateWord);
  if (change.kind == runtime::ChangeKind::Renamed) text += " " + inWords(change.formerName);
  return text + " " + inWords(change.name);
}

ReplaceReport::ReplaceReport(const rung::Replacement& replacement) {
  const rung_replacement_info info = replacement.report();
  keptCells = info.kept_cells;
  keptStates = info.kept_states;
  bound = info.bound;
  for (const rung_change& change : replacement.changes())
    changes.push_back(
        {static_cast<runtime::ChangeKind>(change.kind), change.is_state != 0, change.name, change.former});
}

std::string ReplaceReport::take(const runtime::StateChange& change) {
  const auto found =
      std::ranges::find_if(changes, [&](const runtime::StateChange& other) { return same(change, other); });
  if (found == changes.end())
    return fmt::format("the report does not contain: {}; it contains: {}", textOf(change), listOf(changes));
  changes.erase(found);
  return {};
}

std::string ReplaceReport::expectNone() const {
  return changes.empty() ? std::string() : "there are changes that no expect_change names: " + listOf(changes);
}

std::vector<std::string> ReplaceReport::lines() const {
  std::vector<std::string> lines = {
      fmt::format("kept {} and {}", counted(keptCells, "variable"), counted(keptStates, "internal state"))};
  for (const runtime::StateChange& change : changes)
    lines.push_back(textOf(change) + (change.kind == runtime::ChangeKind::Cut ? kCutNote : ""));
  lines.push_back("a slice may last " + bound);
  return lines;
}

} // namespace rung::scenario
