// Places and the rungs that use them (see cross_reference.h).
#include "tools/xref/cross_reference.h"

#include <algorithm>
#include <tuple>

#include "tools/xref/place_names.h"
#include "tools/xref/place_search.h"

namespace rung::xref {
namespace {

using host::Ref;
using ir::BitRange;

auto orderOf(const BitRange& place) { return std::tuple(place.space.index, place.first, place.count); }

// A rung and a place have one entry, for reads and writes. Accesses come by place, and of one place by rung.
void addAccess(std::vector<Access>& accesses, const Access& access) {
  for (auto at = accesses.rbegin(); at != accesses.rend() && at->rung == access.rung && at->as == access.as; ++at) {
    if (at->indexed != access.indexed) continue;
    at->reads |= access.reads;
    at->writes |= access.writes;
    return;
  }
  accesses.push_back(access);
}

} // namespace

bool Entry::isRead() const { return std::ranges::any_of(accesses, &Access::reads); }
bool Entry::isWritten() const { return std::ranges::any_of(accesses, &Access::writes); }

CrossReference::CrossReference(const rung_program& program, const ir::Uses& uses,
                               std::span<const std::string_view> shown)
    : program_(program), uses_(uses), shown_(shown) {
  for (uint32_t rung = 0; rung < uses.rungCount(); ++rung)
    for (const ir::RungUse& use : uses.of(rung)) {
      const std::optional<BitRange> element = knownPlace(program, uses, use.element);
      const std::optional<BitRange> reach = knownPlace(program, uses, use.place);
      if (!element || !reach) continue;
      const Access access{
          .rung = rung, .reads = !use.writes, .writes = use.writes, .indexed = use.computed, .as = *element};
      sorted_.push_back({access, *reach, use.type});
      longest_ = std::max(longest_, element->count);
    }
  std::ranges::stable_sort(sorted_, {}, [](const Use& use) { return orderOf(use.access.as); });
}

void CrossReference::addPlaces(std::vector<Ref>& places) const {
  for (const Use& use : sorted_) {
    ir::Use place;
    place.place = use.access.as;
    place.type = use.type;
    places.push_back(refOf(place));
  }
  for (uint32_t i = 0; i < program_.symbol_count; ++i) {
    const rung_symbol& symbol = program_.symbols[i];
    if ((symbol.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN)) == 0) places.push_back(host::refOf(symbol));
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

std::vector<Access> CrossReference::accessesOf(const BitRange& bits) const {
  std::vector<Access> accesses;
  forEachAt(
      bits, sorted_, longest_, [](const Use& use) { return use.access.as; },
      [&](const Use& use) { addAccess(accesses, use.access); });
  std::ranges::stable_sort(accesses, {}, &Access::rung);
  return accesses;
}

Entry CrossReference::of(const Ref& place) const {
  Entry entry{.place = place, .accesses = accessesOf(bitsOf(place))};
  entry.controlWrites = isWrittenByControl(program_, uses_, place);
  entry.controlReads = isReadByControl(program_, uses_, place) ||
                       std::ranges::find(shown_, program_.spaces[place.space].name) != shown_.end();
  return entry;
}

std::vector<Access> CrossReference::perhaps(const Ref& place) const {
  std::vector<Access> accesses;
  const BitRange bits = bitsOf(place);
  for (const Use& use : sorted_)
    if (use.access.indexed && !overlap(use.access.as, bits) && overlap(use.reach, bits))
      addAccess(accesses, use.access);
  std::ranges::stable_sort(accesses, {}, &Access::rung);
  return accesses;
}

std::string oddity(const Entry& entry) {
  const bool read = entry.isRead();
  const bool written = entry.isWritten();
  if (!read && !written) return "used by no rung";
  if (!written && !entry.controlWrites) return "read, but written by no rung";
  if (!read && !entry.controlReads) return "written, but read by no rung";
  return {};
}

} // namespace rung::xref
