// Rungs, names and messages of two versions (see difference.h).
#include "tools/difference/difference.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <map>

#include "rtlib/host/rung_alignment.h"
#include "tools/difference/meaning.h"

namespace rung::difference {
namespace {

using ir::Module;
using ir::Symbol;

std::vector<host::RungMark> marksOf(const std::vector<DrawnRung>& rungs) {
  std::vector<host::RungMark> marks;
  for (const DrawnRung& rung : rungs) marks.push_back({rung.routine->name, rung.meaning, rung.rung->title});
  return marks;
}

ChangeKind kindOf(host::RungKind kind) {
  return kind == host::RungKind::Moved ? ChangeKind::Moved : ChangeKind::Changed;
}

// Those that are gone come after what they followed.
void compareRungs(const std::vector<DrawnRung>& before, const std::vector<DrawnRung>& after, Difference& out) {
  const std::vector<host::RungPair> pairs = host::alignRungs(marksOf(before), marksOf(after));
  std::vector<bool> isThere(before.size(), false);
  for (const host::RungPair& pair : pairs) isThere[pair.before] = true;
  size_t b = 0;
  const auto removedUpTo = [&](size_t end) {
    for (; b < end; ++b)
      if (!isThere[b]) out.rungs.push_back({ChangeKind::Removed, before[b].rung, nullptr});
  };
  auto pair = pairs.begin();
  for (uint32_t a = 0; a < after.size(); ++a) {
    if (pair == pairs.end() || pair->after != a) {
      out.rungs.push_back({ChangeKind::Added, nullptr, after[a].rung});
      continue;
    }
    if (pair->kind != host::RungKind::Moved) removedUpTo(pair->before);
    if (pair->kind == host::RungKind::Same)
      ++out.same;
    else
      out.rungs.push_back({kindOf(pair->kind), before[pair->before].rung, after[a].rung});
    ++pair;
  }
  removedUpTo(before.size());
}

// ---- names and messages --------------------------------------------------------------------------------------------

// Of names whose addresses the compiler gives out the type.
std::string meaningOf(const Module& module, const Symbol& symbol) {
  if (!symbol.space.valid()) return fmt::format("constant {}", symbol.value);
  const ir::Space& space = module.at(symbol.space);
  constexpr std::string_view kTypes[] = {"", "bit", "byte", "16 bits", "32 bits", "64 bits", "real"};
  const std::string type(symbol.type < std::size(kTypes) ? kTypes[symbol.type] : "");
  const std::string count = symbol.count > 1 ? fmt::format(" × {}", symbol.count) : "";
  if ((space.flags & RUNG_SPACE_ALLOCATED) != 0) return type + count;
  return fmt::format("{}{}{}", space.name, symbol.byte / space.unitBytes,
                     symbol.type == RUNG_TYPE_BIT ? fmt::format(".{}", symbol.byte % space.unitBytes * 8 + symbol.bit)
                                                  : " " + type) +
         count;
}

using Names = std::map<std::string, std::string>;
using Messages = std::map<uint32_t, std::string>;

Names namesOf(const Module& module) {
  Names names;
  for (const Symbol& symbol : module.symbols)
    if ((symbol.flags & RUNG_SYMBOL_HIDDEN) == 0) names.emplace(symbol.name, meaningOf(module, symbol));
  return names;
}

Messages messagesOf(const Module& module) {
  Messages messages;
  for (const ir::MessageText& message : module.messages) messages.emplace(message.number, message.text);
  return messages;
}

template <class Texts>
std::vector<NameChange> changesOf(const Texts& before, const Texts& after) {
  Texts all = before;
  all.insert(after.begin(), after.end());
  std::vector<NameChange> changes;
  for (const auto& [name, what] : all) {
    const auto old = before.find(name);
    const auto now = after.find(name);
    if (old == before.end())
      changes.push_back({ChangeKind::Added, fmt::format("{}", name), "", now->second});
    else if (now == after.end())
      changes.push_back({ChangeKind::Removed, fmt::format("{}", name), old->second, ""});
    else if (old->second != now->second)
      changes.push_back({ChangeKind::Changed, fmt::format("{}", name), old->second, now->second});
  }
  return changes;
}

} // namespace

std::string_view nameOf(ChangeKind kind) {
  constexpr std::string_view kNames[] = {"added", "removed", "changed", "moved"};
  return kNames[static_cast<int>(kind)];
}

Difference compare(const Module& before, const Module& after) {
  Difference difference;
  compareRungs(drawnRungs(before), drawnRungs(after), difference);
  difference.names = changesOf(namesOf(before), namesOf(after));
  difference.messages = changesOf(messagesOf(before), messagesOf(after));
  return difference;
}

} // namespace rung::difference
