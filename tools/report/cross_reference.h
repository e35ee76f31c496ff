// Which rungs read and which write each place that a program's rungs use or its symbols name. Derived from the IR as
// the front end built it (ir/analysis/uses.h), so it shows what the program does and not how its text looks: an operand
// of four bytes is a use of all of them, an alias a use of the place that it names, and a latch a use of the place from
// which it was copied.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/analysis/uses.h"
#include "ir/core/memory_use.h"
#include "ir/image/program_image.h"
#include "rtlib/load/ref.h"
#include "rung/program.h"

namespace rung::report {

struct RungAccess {
  uint32_t rung = 0; // index in rung_program::rungs; if a drawn rung has several there, the first
  bool reads = false;
  bool writes = false;
  bool indexed = false; // whether an index is added to the address at run time
  ir::BitRange as;      // the place that the rung accesses: the entry's own, or one that overlaps it
};

struct Entry {
  runtime::Ref place;
  std::vector<RungAccess> accesses; // ascending by rung; without indexed accesses of other places that reach it
  bool controlWrites = false;       // whether the control or the machine writes it
  bool controlReads = false;
  // Set by markOdd (odd_names.h).
  bool declared = false;  // whether the program declares it
  std::string_view odd{}; // what looks like a mistake, e.g. "used by no rung"; "" if nothing does

  bool isRead() const;
  bool isWritten() const;
};

class CrossReference {
public:
  // All arguments must outlive it. `shown`: spaces whose cells the control displays or passes on (frontend::Dialect).
  CrossReference(const rung_program& program, const ir::Uses& uses, std::span<const std::string_view> shown);

  // The places that rungs use and the places of symbols, each once, by address.
  std::vector<Entry> all() const;
  Entry of(const runtime::Ref& place) const;
  // Rungs that use a part of the place, ascending; a rung appears once for every place that it uses.
  std::vector<RungAccess> accessesOf(const ir::BitRange& place) const;
  // Rungs that access another place with an index that may reach this one.
  std::vector<RungAccess> perhaps(const runtime::Ref& place) const;

  const rung_program& program() const { return program_; }
  const ir::Uses& uses() const { return uses_; }

private:
  struct Use {
    RungAccess access;
    ir::BitRange place; // the accessed element, as listed
    ir::BitRange reach; // everything that its index may reach, as listed
    ir::Type type = ir::Type::None;
  };
  void add(uint32_t rung, const ir::RungUse& use);
  ir::BitRange listed(const ir::BitRange& place) const;
  bool reaches(const Use& use, const ir::BitRange& bits) const;
  void addPlaces(std::vector<runtime::Ref>& places) const;

  const rung_program& program_;
  const ir::Uses& uses_;
  const std::span<const std::string_view> shown_;
  std::vector<Use> sorted_;  // by place
  std::vector<Use> indexed_; // the indexed ones of sorted_
  uint32_t longest_ = 1;     // bits of the longest element
};

// The cross reference as text, a paragraph per entry, and as JSON for programs. `entries` are of `reference`;
// `perhaps`: also the rungs whose index may reach the place, which takes time in proportion to the program for each
// entry.
std::string shownAsText(const CrossReference& reference, const std::vector<Entry>& entries, bool perhaps);
std::string shownAsJson(const CrossReference& reference, const std::vector<Entry>& entries, bool perhaps);

// The cross reference of a module, with everything that it refers to.

class ModuleReference {
public:
  // `module` and `shown` (see CrossReference) must outlive it.
  ModuleReference(const ir::Module& module, std::span<const std::string_view> shown)
      : layout_(module, {}), image_(layout_, 0), uses_(module), reference_(image_.program(), uses_, shown) {}
  ModuleReference(const ModuleReference&) = delete; // the members refer to each other
  ModuleReference& operator=(const ModuleReference&) = delete;

  const CrossReference& get() const { return reference_; }

private:
  const ir::Layout layout_;
  const ir::ProgramImage image_;
  const ir::Uses uses_;
  const CrossReference reference_;
};

// The places that a program's rungs use, as a user would list them.

struct UsedPlace {
  ir::Use use; // one of its uses
  bool read = false;
  bool written = false;
};

// Places at fixed addresses, each once, by address; a use of a latch counts as a use of the place from which it was
// copied.
std::vector<UsedPlace> usedPlaces(const rung_program& program, const ir::Uses& uses);

// A set of bits, to test whether places share one.
class PlaceSet {
public:
  explicit PlaceSet(std::vector<ir::BitRange> places);
  bool meets(const ir::BitRange& place) const;

private:
  std::vector<ir::BitRange> places_; // ascending; no two are adjacent
};
PlaceSet writtenPlaces(const std::vector<UsedPlace>& places);

// Searches a list that is sorted by place for the items that overlap a place.

// The first sort key of such a list.
inline std::pair<uint32_t, uint32_t> startOf(const ir::BitRange& place) { return {place.space.index, place.first}; }

// Calls `visit` with each item of `sorted` that has a bit in common with `place`, in their order. `placeOf` is an
// item's place; none has more than `longest` bits.
template <class Items, class PlaceOf, class Visit>
void forEachAt(const ir::BitRange& place, const Items& sorted, uint32_t longest, PlaceOf placeOf, Visit visit) {
  const std::pair earliest{place.space.index, place.first - std::min(place.first, longest)};
  const std::pair end{place.space.index, place.first + place.count};
  const auto start = [&](const auto& item) { return startOf(placeOf(item)); };
  for (auto at = std::ranges::lower_bound(sorted, earliest, {}, start); at != sorted.end() && start(*at) < end; ++at)
    if (ir::overlap(placeOf(*at), place)) visit(*at);
}

} // namespace rung::report
