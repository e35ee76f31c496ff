// Places and the rungs that use them (see cross_reference.h).
#include "tools/report/cross_reference.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "tools/report/place_names.h"
#include "tools/report/place_search.h"

namespace rung::report {
namespace {

using ir::BitRange;
using runtime::Ref;

auto orderOf(const BitRange& place) { return std::tuple(place.space.index, place.first, place.count); }

// A rung and a place have one entry, for reads and writes. Accesses come by place, and of one place by rung.
void addRungAccess(std::vector<RungAccess>& accesses, const RungAccess& access) {
  for (auto at = accesses.rbegin(); at != accesses.rend() && at->rung == access.rung && at->as == access.as; ++at) {
    if (at->indexed != access.indexed) continue;
    at->reads |= access.reads;
    at->writes |= access.writes;
    return;
  }
  accesses.push_back(access);
}

} // namespace

bool Entry::isRead() const { return std::ranges::any_of(accesses, &RungAccess::reads); }
bool Entry::isWritten() const { return std::ranges::any_of(accesses, &RungAccess::writes); }

CrossReference::CrossReference(const rung_program& program, const ir::Uses& uses,
                               std::span<const std::string_view> shown)
    : program_(program), uses_(uses), shown_(shown) {
  // The first of those that are the same lines: of a subprogram that two levels run.
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> drawn; // by number and last line
  for (uint32_t rung = 0; rung < uses.rungCount(); ++rung) {
    const rung_rung_info& info = program.rungs[rung];
    const uint32_t first =
        info.number == 0 ? rung : drawn.try_emplace({info.number, info.last_line}, rung).first->second;
    for (const ir::RungUse& use : uses.of(rung))
      if (!use.keeps) add(first, use);
  }
  std::ranges::stable_sort(sorted_, {}, [](const Use& use) { return std::pair(orderOf(use.place), use.access.rung); });
  std::ranges::copy_if(sorted_, std::back_inserter(indexed_), [](const Use& use) { return use.access.indexed; });
}

void CrossReference::add(uint32_t rung, const ir::RungUse& use) {
  const std::optional<BitRange> element = knownPlace(program_, uses_, use.element);
  const std::optional<BitRange> reach = knownPlace(program_, uses_, use.place);
  if (!element || !reach) return;
  const RungAccess access{
      .rung = rung, .reads = !use.writes, .writes = use.writes, .indexed = use.computed, .as = *element};
  sorted_.push_back({access, listed(*element), listed(*reach), use.type});
  longest_ = std::max(longest_, element->count);
}

BitRange CrossReference::listed(const BitRange& place) const { return listedPlace(program_, uses_, place); }

void CrossReference::addPlaces(std::vector<Ref>& places) const {
  for (const Use& use : sorted_) {
    ir::Use place;
    place.place = use.place;
    place.type = use.type;
    places.push_back(refOf(place));
  }
  for (uint32_t i = 0; i < program_.symbol_count; ++i) {
    const rung_symbol& symbol = program_.symbols[i];
    if ((symbol.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN)) == 0) places.push_back(runtime::refOf(symbol));
  }
}

std::vector<Entry> CrossReference::all() const {
  std::vector<Ref> places;
  addPlaces(places);
  std::ranges::stable_sort(places, {}, [](const Ref& place) { return orderOf(bitsOf(place)); });
  std::vector<Entry> entries;
  for (const Ref& place : places)
    if (entries.empty() || bitsOf(entries.back().place) != bitsOf(place)) entries.push_back(of(place));
  return entries;
}

std::vector<RungAccess> CrossReference::accessesOf(const BitRange& bits) const {
  std::vector<RungAccess> accesses;
  forEachAt(
      listed(bits), sorted_, longest_, [](const Use& use) { return use.place; },
      [&](const Use& use) { addRungAccess(accesses, use.access); });
  std::ranges::stable_sort(accesses, {}, &RungAccess::rung);
  return accesses;
}

Entry CrossReference::of(const Ref& asked) const {
  Ref place = asked;
  const BitRange own = listed(bitsOf(asked));
  place.space = own.space.index;
  place.byte = own.first / 8;
  Entry entry{.place = place, .accesses = accessesOf(own)};
  entry.controlWrites = isWrittenByControl(program_, uses_, place);
  entry.controlReads = isReadByControl(program_, uses_, place) ||
                       std::ranges::find(shown_, program_.spaces[place.space].name) != shown_.end();
  return entry;
}

// A reach is not another place's as a whole where only part of it is: what is copied is so bit by bit.
bool CrossReference::reaches(const Use& use, const BitRange& bits) const {
  if (overlap(use.reach, bits)) return true;
  const BitRange copied{use.reach.space, bits.first, bits.count};
  return overlap(use.reach, copied) && listed(copied) == bits;
}

std::vector<RungAccess> CrossReference::perhaps(const Ref& place) const {
  std::vector<RungAccess> accesses;
  const BitRange bits = listed(bitsOf(place));
  for (const Use& use : indexed_)
    if (!overlap(use.place, bits) && reaches(use, bits)) addRungAccess(accesses, use.access);
  std::ranges::stable_sort(accesses, {}, &RungAccess::rung);
  return accesses;
}

} // namespace rung::report
