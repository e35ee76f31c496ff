// What the readers keep, and what a program begins with.
#include "frontend/network/convert/source_program.h"

#include <algorithm>
#include <iterator>
#include <ranges>

#include "frontend/network/read/reading.h"
#include "ir/support/check.h"

namespace rung::frontend::network {
namespace {

using Kind = Item::Kind;

// The gap that the files begin with: that of the dialect. Without one it is of a list, which has the order of units.
Gap& firstGap(SourceProgram& source) {
  std::vector<Gap*> gaps;
  for (Unit& unit : source.program.units) {
    if (!unit.lead.empty()) gaps.push_back(&unit.lead);
    for (size_t i = 0; i < withoutEnd(unit).size(); ++i) gaps.push_back(&unit.networks[i].gap);
  }
  gaps.push_back(&source.tail);
  const auto at = std::ranges::find_if(
      gaps, [](const Gap* gap) { return std::ranges::find(*gap, Kind::Dialect, &Item::kind) != gap->end(); });
  return at == gaps.end() ? *gaps[0] : **at;
}

// With one dialect statement, before all others.
void splitPreamble(SourceProgram& source) {
  Gap& gap = firstGap(source);
  auto dialect = std::ranges::find(gap, Kind::Dialect, &Item::kind);
  if (dialect == gap.end()) dialect = gap.insert(gap.begin(), {Kind::Dialect});
  const auto isStatement = [](const Item& item) { return item.kind != Kind::Comment && item.kind != Kind::Blank; };
  std::rotate(std::ranges::find_if(gap, isStatement), dialect, dialect + 1);
  const auto isOfPreamble = [&](const Item& item) { return isStatement(item) && item.kind != Kind::Section; };
  const auto end = std::ranges::find_if(gap | std::views::reverse, isOfPreamble).base();
  source.preamble.assign(std::make_move_iterator(gap.begin()), std::make_move_iterator(end));
  gap.erase(gap.begin(), end);
}

} // namespace

SourceProgram readSource(const Language& language, SourceManager& sources, std::span<const FileId> files) {
  Diagnostics heard; // all of it is reported
  Context context{.language = language, .sources = sources, .diagnostics = heard};
  context.gaps.keep();
  SourceProgram source{.sources = sources, .program = Program(language), .preamble = {}, .tail = {}};
  Reading reading(context, source.program);
  for (FileId file : files) reading.add(file);
  reading.read();
  RUNG_CHECK(!heard.hasErrors(), "the program has no errors");
  source.tail = context.gaps.take();
  splitPreamble(source);
  return source;
}

} // namespace rung::frontend::network
