// Places and the rungs that use them.
#include "tools/report/cross_reference.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "ir/support/put.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "tools/report/place_names.h"

namespace rung::report {

namespace {

using ir::BitRange;
using runtime::Ref;

auto orderOf(const BitRange& place) { return std::tuple(place.space.index, place.first, place.count); }

// A rung and a place have one entry, for reads and writes. Accesses are added by place, and for one place by rung.
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
  // By number and last line, the first of several rungs with the same lines: those of a subprogram that two levels run.
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> drawn; // by number and last line
  for (uint32_t rung = 0; rung < uses.rungCount(); ++rung) {
    const rung_info& info = program.rungs[rung];
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
  const auto byControl = std::ranges::stable_partition(entry.accesses, [&](const RungAccess& access) {
    const rung_info& rung = program_.rungs[access.rung];
    return rung.number != 0 || rung.file == RUNG_NONE; // otherwise it is the control's, at the lines of the next rung
  });
  const bool writes = std::ranges::any_of(byControl, &RungAccess::writes);
  entry.accesses.erase(byControl.begin(), byControl.end());
  entry.controlWrites = writes || isWrittenByControl(program_, uses_, place);
  entry.controlReads = isReadByControl(program_, uses_, place) ||
                       std::ranges::find(shown_, program_.spaces[place.space].name) != shown_.end();
  return entry;
}

// A use that reaches only a part of another place is not a use of the whole: copying is done bit by bit.
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

std::vector<UsedPlace> usedPlaces(const rung_program& program, const ir::Uses& uses) {
  std::vector<UsedPlace> all;
  for (uint32_t rung = 0; rung < uses.rungCount(); ++rung)
    for (ir::Use use : uses.of(rung)) {
      const std::optional<ir::BitRange> known = knownPlace(program, uses, use.place);
      if (use.computed || !known) continue;
      use.place = *known;
      all.push_back({use, !use.writes, use.writes});
    }
  const auto order = [](const UsedPlace& place) {
    const ir::BitRange& bits = place.use.place;
    return std::tuple(bits.space.index, bits.first, bits.count, static_cast<int>(place.use.type));
  };
  std::ranges::sort(all, {}, order);
  std::vector<UsedPlace> places;
  for (const UsedPlace& place : all) {
    if (places.empty() || order(places.back()) != order(place)) places.push_back(place);
    places.back().read |= place.read;
    places.back().written |= place.written;
  }
  return places;
}

PlaceSet::PlaceSet(std::vector<ir::BitRange> places) {
  const auto order = [](const ir::BitRange& bits) { return std::pair(bits.space.index, bits.first); };
  std::ranges::sort(places, {}, order);
  for (const ir::BitRange& bits : places) {
    const bool touches = !places_.empty() && places_.back().space == bits.space &&
                         bits.first <= places_.back().first + places_.back().count;
    if (!touches) places_.push_back(bits);
    ir::BitRange& last = places_.back();
    last.count = std::max(last.count, bits.first + bits.count - last.first);
  }
}

bool PlaceSet::meets(const ir::BitRange& place) const {
  const auto order = [](const ir::BitRange& bits) { return std::pair(bits.space.index, bits.first); };
  const auto after =
      std::ranges::lower_bound(places_, std::pair(place.space.index, place.first + place.count), {}, order);
  return after != places_.begin() && ir::overlap(*std::prev(after), place);
}

PlaceSet writtenPlaces(const std::vector<UsedPlace>& places) {
  std::vector<ir::BitRange> written;
  for (const UsedPlace& place : places)
    if (place.written) written.push_back(place.use.place);
  return PlaceSet(std::move(written));
}

// The cross reference as text.

namespace {

// "as D20 to D23", "as 7000, indexed": if the rung accesses another place than the entry's own.
std::string formOf(const rung_program& program, const Entry& entry, const RungAccess& access) {
  const std::string_view indexed = access.indexed ? ", indexed" : "";
  if (access.as == bitsOf(entry.place)) return std::string(indexed);
  const rung_space& space = program.spaces[access.as.space.index];
  const auto addressAt = [&](uint32_t bit) {
    const uint32_t byte = bit / 8;
    if (access.as.count == 1) return nc::address(program, runtime::bitRef(access.as.space.index, byte, bit % 8));
    return nc::address(program, runtime::intRef(access.as.space.index, byte - byte % space.unit_bytes, 8));
  };
  const std::string from = addressAt(access.as.first);
  const std::string to = addressAt(access.as.first + access.as.count - 1);
  return fmt::format(", as {}{}{}", from, from == to ? "" : " to " + to, indexed);
}

void addAccesses(const rung_program& program, const Entry& entry, bool RungAccess::* kind, std::string_view title,
                 std::string_view otherwise, std::string& out) {
  bool any = false;
  for (const RungAccess& access : entry.accesses) {
    if (!(access.*kind)) continue;
    put(out, "  {:<8} {}{}\n", any ? "" : title, runtime::rungText(program, access.rung),
        formOf(program, entry, access));
    any = true;
  }
  if (!any) put(out, "  {:<8} {}\n", title, otherwise);
}

void addPerhaps(const CrossReference& reference, const Entry& entry, std::string& out) {
  for (const RungAccess& access : reference.perhaps(entry.place))
    put(out, "  perhaps  {} {}{}\n", access.reads ? access.writes ? "read and written by" : "read by" : "written by",
        runtime::rungText(reference.program(), access.rung), formOf(reference.program(), entry, access));
}

} // namespace

std::string shownAsText(const CrossReference& reference, const std::vector<Entry>& entries, bool perhaps) {
  const rung_program& program = reference.program();
  std::string out;
  for (const Entry& entry : entries) {
    if (!out.empty()) out += '\n';
    put(out, "{}{}{}\n", shownName(program, entry.place), entry.odd.empty() ? "" : ": ", entry.odd);
    addAccesses(program, entry, &RungAccess::writes, "written",
                entry.controlWrites ? "by the control or the machine" : "–", out);
    addAccesses(program, entry, &RungAccess::reads, "read", entry.controlReads ? "by the control or the machine" : "–",
                out);
    if (perhaps) addPerhaps(reference, entry, out);
  }
  return out;
}

// The cross reference as JSON.

namespace {

using Json = nlohmann::ordered_json;

// With the length of a cell if several places with one name differ only in length.
std::string addressOf(const rung_program& program, const runtime::Ref& place) {
  return nc::hasAddresses(program) ? nc::address(program, place) : nc::cellAddress(program, place);
}

Json accessJson(const rung_program& program, const RungAccess& access) {
  const rung_info& rung = program.rungs[access.rung];
  const bool added = rung.file == RUNG_NONE; // by the compiler
  Json json = {{"rung", rung.number}, {"file", added ? "" : program.files[rung.file]}, {"line", rung.first_line}};
  const uint32_t byte = access.as.first / 8;
  const uint32_t space = access.as.space.index;
  const bool bit = access.as.count == 1;
  json["address"] =
      nc::address(program, bit ? runtime::bitRef(space, byte, access.as.first % 8) : runtime::intRef(space, byte, 8));
  json["bits"] = access.as.count;
  if (access.indexed) json["indexed"] = true;
  return json;
}

Json accessesJson(const rung_program& program, const std::vector<RungAccess>& accesses, bool RungAccess::* kind) {
  Json list = Json::array();
  for (const RungAccess& access : accesses)
    if (access.*kind) list.push_back(accessJson(program, access));
  return list;
}

} // namespace

std::string shownAsJson(const CrossReference& reference, const std::vector<Entry>& entries, bool perhaps) {
  const rung_program& program = reference.program();
  Json list = Json::array();
  for (const Entry& entry : entries) {
    Json json = {{"name", symbolAt(program, entry.place)}, {"address", addressOf(program, entry.place)}};
    json["written"] = accessesJson(program, entry.accesses, &RungAccess::writes);
    json["read"] = accessesJson(program, entry.accesses, &RungAccess::reads);
    if (entry.controlWrites) json["control_writes"] = true;
    if (entry.controlReads) json["control_reads"] = true;
    if (!entry.odd.empty()) json["odd"] = entry.odd;
    if (perhaps) {
      const std::vector<RungAccess> others = reference.perhaps(entry.place);
      json["perhaps_written"] = accessesJson(program, others, &RungAccess::writes);
      json["perhaps_read"] = accessesJson(program, others, &RungAccess::reads);
    }
    list.push_back(std::move(json));
  }
  return list.dump(2) + "\n";
}

} // namespace rung::report
