// Rungs, names, contents, messages and configuration of two versions.
#include "tools/report/difference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>

#include "ir/support/put.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/text/letters.h"
#include "tools/report/difference_cells.h"
#include "tools/report/difference_pairs.h"

namespace rung::report {

namespace {

using ir::Module;
using ir::Symbol;

ChangeKind kindOf(runtime::RungKind kind) {
  return kind == runtime::RungKind::Moved ? ChangeKind::Moved : ChangeKind::Changed;
}

ShownRung shown(const DrawnRung& drawn) { return {.rung = drawn.rung, .routine = drawn.routine}; }

// A removed rung follows the rung that it followed before.
void compareRungs(const PairedRungs& paired, Difference& out) {
  const std::vector<DrawnRung>&before = paired.before(), &after = paired.after();
  std::vector<bool> isThere(before.size(), false);
  for (const PairedRungs::Pair& pair : paired.pairs()) isThere[pair.before] = true;
  size_t b = 0;
  const auto removedUpTo = [&](size_t end) {
    for (; b < end; ++b)
      if (!isThere[b]) out.rungs.push_back({ChangeKind::Removed, shown(before[b]), {}, {}});
  };
  auto pair = paired.pairs().begin();
  for (uint32_t a = 0; a < after.size(); ++a) {
    if (pair == paired.pairs().end() || pair->after != a) {
      out.rungs.push_back({ChangeKind::Added, {}, shown(after[a]), {}});
      continue;
    }
    if (pair->kind != runtime::RungKind::Moved) removedUpTo(pair->before);
    if (pair->kind == runtime::RungKind::Same && pair->paths.empty())
      ++out.same;
    else
      out.rungs.push_back({pair->paths.empty() ? kindOf(pair->kind) : ChangeKind::Changed, shown(before[pair->before]),
                           shown(after[a]), pair->paths});
    ++pair;
  }
  removedUpTo(before.size());
}

// ---- names, contents, messages, configuration ---------------------------------------------------------------------

// For names whose addresses the compiler assigns, the type.
std::string meaningOf(const rung_program& program, const Symbol& symbol) {
  if (!symbol.space.valid()) return fmt::format("constant {}", symbol.value);
  constexpr std::string_view kTypes[] = {"", "bit", "byte", "16 bits", "32 bits", "64 bits", "real"};
  const std::string type(symbol.type < std::size(kTypes) ? kTypes[symbol.type] : "");
  const std::string count = symbol.count > 1 ? fmt::format(" × {}", symbol.count) : "";
  if ((program.spaces[symbol.space.index].flags & RUNG_SPACE_ALLOCATED) != 0) return type + count;
  const runtime::Ref place = symbol.type == RUNG_TYPE_BIT ? runtime::bitRef(symbol.space.index, symbol.byte, symbol.bit)
                                                          : runtime::intRef(symbol.space.index, symbol.byte, 8);
  return nc::address(program, place) + (symbol.type == RUNG_TYPE_BIT ? "" : " " + type) + count;
}

// What a name means, by the name as the dialect compares it.
struct Named {
  std::string name; // as the program writes it
  std::string meaning;
  bool operator==(const Named& other) const { return meaning == other.meaning; }
};
using Texts = std::map<std::string, Named>;

std::string compared(const Version& version, const std::string& name) {
  return nc::naming(version.program).ignoresCase ? text::upper(name) : name;
}

Texts namesOf(const Version& version) {
  Texts names;
  for (const Symbol& symbol : version.module.symbols)
    if ((symbol.flags & RUNG_SYMBOL_HIDDEN) == 0 && !version.controlNames.contains(text::upper(symbol.name)))
      names.emplace(compared(version, symbol.name), Named{symbol.name, meaningOf(version.program, symbol)});
  return names;
}

std::map<uint32_t, std::string> messagesOf(const Module& module) {
  std::map<uint32_t, std::string> messages;
  for (const ir::MessageText& message : module.messages) messages.emplace(message.number, message.text);
  return messages;
}

std::string textOf(const std::string& text) { return text; }
std::string textOf(const Setting& setting) { return setting.text; }
std::string textOf(const Named& named) { return named.meaning; }

// Calls `visit` with key, old and new value of all entries that differ; null if there is none.
template <class Values, class Visit>
void eachChange(const Values& before, const Values& after, Visit visit) {
  auto b = before.begin();
  auto a = after.begin();
  while (b != before.end() || a != after.end()) {
    const bool gone = a == after.end() || (b != before.end() && b->first < a->first);
    const bool isNew = !gone && (b == before.end() || a->first < b->first);
    if (gone)
      visit(b->first, &b->second, nullptr);
    else if (isNew)
      visit(a->first, nullptr, &a->second);
    else if (!(b->second == a->second))
      visit(a->first, &b->second, &a->second);
    if (!isNew) ++b;
    if (!gone) ++a;
  }
}

template <class Value>
NameChange changeOf(std::string name, const Value* before, const Value* after) {
  const ChangeKind kind = before == nullptr  ? ChangeKind::Added
                          : after == nullptr ? ChangeKind::Removed
                                             : ChangeKind::Changed;
  return {kind, std::move(name), before != nullptr ? textOf(*before) : "", after != nullptr ? textOf(*after) : ""};
}

std::vector<NameChange> compareNames(const Version& before, const Version& after, const FormerNames& former) {
  std::vector<NameChange> changes;
  eachChange(namesOf(before), namesOf(after), [&](const std::string&, const Named* old, const Named* now) {
    changes.push_back(changeOf(now != nullptr ? now->name : old->name, old, now));
  });
  std::ranges::move(compareBits(before, after, former), std::back_inserter(changes));
  std::ranges::stable_sort(changes, {}, &NameChange::name);
  return changes;
}

// Of a variable that only one version has, the initial contents count.
std::vector<NameChange> compareContents(const Version& before, const Version& after) {
  std::vector<NameChange> changes;
  const Texts names[] = {namesOf(before), namesOf(after)};
  const auto isNamed = [&](int version, const std::string& cell) {
    return names[version].contains(cell.substr(0, cell.rfind('['))) || names[version].contains(cell);
  };
  eachChange(initialContents(before.program), initialContents(after.program),
             [&](const auto& cell, const std::string* old, const std::string* now) {
               const std::string zero = zeroLike(old != nullptr ? *old : *now);
               if (old == nullptr && isNamed(0, cell.first)) old = &zero;
               if (now == nullptr && isNamed(1, cell.first)) now = &zero;
               const std::string& only = old != nullptr ? *old : *now;
               if ((old != nullptr && now != nullptr) || only != zero)
                 changes.push_back(changeOf(cell.first, old, now));
             });
  return changes;
}

std::vector<NameChange> compareMessages(const Module& before, const Module& after, const Options& options) {
  std::vector<NameChange> changes;
  if (!options.messages) return changes;
  eachChange(messagesOf(before), messagesOf(after),
             [&](uint32_t number, const std::string* old, const std::string* now) {
               const std::string name = options.textName != nullptr ? options.textName(number) : "";
               changes.push_back(changeOf(name.empty() ? fmt::format("{}", number) : name, old, now));
             });
  return changes;
}

std::vector<NameChange> compareSettings(const Settings& before, const Settings& after) {
  std::vector<NameChange> changes;
  eachChange(before, after, [&](const std::string& key, const Setting* old, const Setting* now) {
    NameChange change = changeOf(key, old, now);
    if (old != nullptr && now != nullptr && old->meaning == now->meaning) change.after += " with other contents";
    changes.push_back(std::move(change));
  });
  return changes;
}

} // namespace

std::string_view nameOf(ChangeKind kind) {
  constexpr std::string_view kNames[] = {"added", "removed", "changed", "moved"};
  return kNames[static_cast<int>(kind)];
}

Difference compare(const Version& before, const Version& after, const Options& options) {
  Difference difference;
  const FormerNames former = formerNames(before, after);
  compareRungs(PairedRungs(before, after, former), difference);
  difference.names = compareNames(before, after, former);
  difference.contents = compareContents(before, after);
  difference.messages = compareMessages(before.module, after.module, options);
  difference.settings = compareSettings(before.settings, after.settings);
  difference.lines = compareLines(before, after, former);
  return difference;
}

// The difference as JSON.

namespace {

using Json = nlohmann::ordered_json;

Json rungJson(const ir::Module& module, const ShownRung& shown) {
  const ir::Rung* rung = shown.rung;
  if (rung == nullptr) return nullptr;
  return {{"number", rung->number},
          {"title", rung->title},
          {"routine", shownName(*shown.routine)},
          {"file", module.files[rung->begin.file.index]},
          {"line", rung->begin.line},
          {"text", rung->sourceText}};
}

Json namesJson(const std::vector<NameChange>& changes) {
  Json list = Json::array();
  for (const NameChange& change : changes)
    list.push_back(
        {{"change", nameOf(change.kind)}, {"name", change.name}, {"before", change.before}, {"after", change.after}});
  return list;
}

Json linesJson(const std::vector<LineChange>& changes) {
  Json list = Json::array();
  for (const LineChange& change : changes)
    list.push_back({{"name", change.name}, {"before", change.before}, {"after", change.after}});
  return list;
}

} // namespace

std::string shownAsJson(const Difference& difference, const ir::Module& before, const ir::Module& after) {
  Json rungs = Json::array();
  for (const RungChange& change : difference.rungs) {
    Json paths = Json::array();
    for (const ChangedPath& path : change.paths) paths.push_back({{"before", path.before}, {"after", path.after}});
    rungs.push_back({{"change", nameOf(change.kind)},
                     {"before", rungJson(before, change.before)},
                     {"after", rungJson(after, change.after)},
                     {"leads", std::move(paths)}});
  }
  const Json json = {{"rungs", std::move(rungs)},
                     {"same", difference.same},
                     {"names", namesJson(difference.names)},
                     {"contents", namesJson(difference.contents)},
                     {"messages", namesJson(difference.messages)},
                     {"configuration", namesJson(difference.settings)},
                     {"lines", linesJson(difference.lines)}};
  return json.dump(2) + "\n";
}

// The difference as text.

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
  for (const ChangedPath& path : change.paths) put(out, "  leads to {}, before: to {}\n", path.after, path.before);
}

void addNames(const std::vector<NameChange>& changes, std::string_view what, std::string& out) {
  for (const NameChange& change : changes) {
    put(out, "{} {}{}: {}", nameOf(change.kind), what, change.name,
        change.kind == ChangeKind::Added ? change.after : change.before);
    if (change.kind == ChangeKind::Changed) put(out, " to {}", change.after);
    out += '\n';
  }
}

// The text of an entry that is not a message says what it is.
void addMessages(const std::vector<NameChange>& changes, std::string& out) {
  for (const NameChange& change : changes) {
    const bool isMessage = change.name.find_first_not_of("0123456789") == std::string::npos;
    addNames({change}, isMessage ? "message " : "", out);
  }
}

// "36 → 38, 40 → 42": the values that differ, or all if one version has more of them; of many, the first ones.
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
  return name.substr(0, name.find('@', 1)); // a unit that exists once for each level that runs it
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
