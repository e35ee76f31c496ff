// Who reads and who writes what: of each place that a program's rungs use or its symbols name, the rungs. Made of the
// IR as the front end built it (ir/analysis/uses.h), so it says what the program does and not what its text looks like:
// an operand of four bytes is a use of all of them, an alias one of the place it names, and a latch one of what it was
// copied from.
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
  uint32_t rung = 0; // as in rung_program::rungs; of one that is drawn and several there, the first
  bool reads = false;
  bool writes = false;
  bool indexed = false; // something is added to the address at run time
  ir::BitRange as;      // what the rung accesses; the entry's own place, or one that overlaps it
};

struct Entry {
  runtime::Ref place;
  std::vector<RungAccess> accesses; // by rung, ascending; what an index may lead to from elsewhere is not among them
  bool controlWrites = false;       // the control or the machine, not a rung
  bool controlReads = false;
  // By markOdd (odd_names.h).
  bool declared = false;  // by the program
  std::string_view odd{}; // what looks like a mistake, e.g. "used by no rung"; empty: nothing does

  bool isRead() const;
  bool isWritten() const;
};

class CrossReference {
public:
  // All must outlive it. `shown`: spaces whose cells the control shows or passes on (frontend::Dialect).
  CrossReference(const rung_program& program, const ir::Uses& uses, std::span<const std::string_view> shown);

  // Places that rungs use and places of symbols, each once, in the order of addresses.
  std::vector<Entry> all() const;
  Entry of(const runtime::Ref& place) const;
  // Rungs that use something of the place, ascending; each once for every place that it uses.
  std::vector<RungAccess> accessesOf(const ir::BitRange& place) const;
  // Rungs whose index may lead to the place, from another one.
  std::vector<RungAccess> perhaps(const runtime::Ref& place) const;

  const rung_program& program() const { return program_; }
  const ir::Uses& uses() const { return uses_; }

private:
  struct Use {
    RungAccess access;
    ir::BitRange place; // that it is listed under, as `reach`
    ir::BitRange reach; // with an index
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
  std::vector<Use> indexed_; // of these
  uint32_t longest_ = 1;     // bits of an element
};

// For people, an entry a paragraph, and for programs. `entries` are of `reference`; `perhaps`: with the rungs whose
// index may lead there, which takes time in proportion to the program for each entry.
std::string shownAsText(const CrossReference& reference, const std::vector<Entry>& entries, bool perhaps);
std::string shownAsJson(const CrossReference& reference, const std::vector<Entry>& entries, bool perhaps);

// The cross reference of a module, with all that it refers to.

class ModuleReference {
public:
  // `module` and `shown` (see CrossReference) must outlive it.
  ModuleReference(const ir::Module& module, std::span<const std::string_view> shown)
      : layout_(module, {}), image_(layout_, 0), uses_(module), reference_(image_.program(), uses_, shown) {}
  ModuleReference(const ModuleReference&) = delete; // the parts refer to each other
  ModuleReference& operator=(const ModuleReference&) = delete;

  const CrossReference& get() const { return reference_; }

private:
  const ir::Layout layout_;
  const ir::ProgramImage image_;
  const ir::Uses uses_;
  const CrossReference reference_;
};

// The places that a program's rungs use, as a person would list them.

struct UsedPlace {
  ir::Use use; // one of them
  bool read = false;
  bool written = false;
};

// At fixed addresses, each once and in their order; what a latch holds counts as a use of what it was copied from.
std::vector<UsedPlace> usedPlaces(const rung_program& program, const ir::Uses& uses);

// Bits of places, to ask of others whether they share one.
class PlaceSet {
public:
  explicit PlaceSet(std::vector<ir::BitRange> places);
  bool meets(const ir::BitRange& place) const;

private:
  std::vector<ir::BitRange> places_; // ascending, none touches the next
};
PlaceSet writtenPlaces(const std::vector<UsedPlace>& places);

// Finds what lies at a place in a list that is sorted by place.

// What such a list is sorted by first.
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
