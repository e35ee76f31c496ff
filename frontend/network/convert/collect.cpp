// Lists first, as they are read, then ladders; then what both forms want the same way.
#include "frontend/network/convert/collect.h"

#include <algorithm>
#include <iterator>

#include "frontend/network/convert/collector.h"
#include "ir/support/check.h"

namespace rung::network::convert {
namespace {

using Kind = Item::Kind;

bool isDeclaration(const Item& item) { return item.kind == Kind::Symbol || item.kind == Kind::Const; }
bool isSpace(const Item& item) { return item.kind == Kind::Comment || item.kind == Kind::Blank; }

// The gap that the file begins with.
Gap& firstGap(SourceProgram& program) {
  for (SourceUnit& unit : program.units) {
    if (!unit.lead.empty()) return unit.lead;
    if (!unit.networks.empty()) return unit.networks[0].gap;
  }
  return program.tail;
}

void splitPreamble(SourceProgram& program) {
  Gap& gap = firstGap(program);
  const auto last = std::find_if(gap.rbegin(), gap.rend(),
                                 [](const Item& item) { return isDeclaration(item) || item.kind == Kind::Dialect; });
  program.preamble.assign(std::make_move_iterator(gap.begin()), std::make_move_iterator(last.base()));
  gap.erase(gap.begin(), last.base());
}

// A dialect statement elsewhere says nothing; its comment stays.
void dropDialects(Gap& gap) {
  for (Item& item : gap) {
    if (item.kind != Kind::Dialect) continue;
    item.kind = item.comment.empty() ? Kind::Blank : Kind::Comment;
    item.text = std::move(item.comment);
    item.comment.clear();
  }
}

// One dialect statement, before all other statements.
void settleDialect(SourceProgram& program) {
  Gap& gap = firstGap(program);
  const auto at = std::find_if(gap.begin(), gap.end(), [](const Item& item) { return item.kind == Kind::Dialect; });
  Item own{Kind::Dialect};
  if (at != gap.end()) own.comment = std::exchange(at->comment, {});
  const bool leads = at != gap.end() && std::all_of(gap.begin(), at, isSpace);
  const auto place = leads ? at - gap.begin() : 0;
  if (at != gap.end()) gap.erase(at);
  for (SourceUnit& unit : program.units) {
    dropDialects(unit.lead);
    for (SourceNetwork& network : unit.networks) dropDialects(network.gap);
  }
  dropDialects(program.tail);
  gap.insert(gap.begin() + place, std::move(own));
}

// Those that the files do not have, and before the subprograms.
void completeLevels(SourceProgram& program, uint32_t levels) {
  const auto hasLevel = [&](uint32_t level) {
    return std::ranges::any_of(
        program.units, [level](const SourceUnit& unit) { return unit.kind == UnitKind::Level && unit.level == level; });
  };
  for (uint32_t level = 0; level < levels; ++level)
    if (!hasLevel(level)) program.units.push_back({.kind = UnitKind::Level, .level = level});
  std::ranges::stable_sort(program.units, {}, [](const SourceUnit& unit) { return std::pair(unit.kind, unit.level); });
}

} // namespace

SourceProgram collect(Context& context, const Reading& reading, const std::vector<Network>& networks) {
  Collector collector{context, networks};
  for (FileId file : reading.lists()) collectList(collector, file);
  for (const ladder::LadderFile& file : reading.ladders()) collectLadder(collector, file);
  RUNG_CHECK(collector.networks.empty(), "every network is in a file");
  collector.program.tail = collector.takeGap();
  settleDialect(collector.program);
  splitPreamble(collector.program);
  completeLevels(collector.program, static_cast<uint32_t>(context.language.levels.size()));
  return std::move(collector.program);
}

} // namespace rung::network::convert
