// Who reads and who writes what: of each place that a program's rungs use or its symbols name, the rungs. Made of the
// IR as the front end built it (ir/analysis/uses.h), so it says what the program does and not what its text looks like:
// an operand of four bytes is a use of all of them, an alias one of the place it names, and a latch one of what it was
// copied from.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/analysis/uses.h"
#include "rtlib/load/ref.h"

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

} // namespace rung::report
