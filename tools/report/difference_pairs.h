// The rungs of two versions in pairs, and where they lead.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rtlib/change/rung_alignment.h"
#include "tools/report/difference.h"
#include "tools/report/difference_cells.h"
#include "tools/report/difference_meaning.h"

namespace rung::report {

// Rungs are aligned by their meaning and their place; a subroutine of another name is the same if most of its rungs are
// (runtime::alignRungs does the rest). Two equal rungs lead to the same if their targets are a pair, or if the first
// rungs from the targets on that both versions have are one: inserting or removing a rung after a label changes no jump
// to it.
class PairedRungs {
public:
  PairedRungs(const Version& before, const Version& after, const FormerNames& former);

  struct Pair {
    uint32_t before = 0; // index in the list of drawn rungs
    uint32_t after = 0;
    runtime::RungKind kind = runtime::RungKind::Same;
    std::vector<ChangedPath> paths; // changed exits of rungs that mean the same
  };

  const std::vector<DrawnRung>& before() const { return before_; }
  const std::vector<DrawnRung>& after() const { return after_; }
  const std::vector<Pair>& pairs() const { return pairs_; } // ascending by `after`

private:
  void pairRoutines(const Version& before, const Version& after);
  void findKept();
  bool leadsAlike(const Exit& before, const Exit& after) const;
  std::vector<ChangedPath> pathsOf(const Version& before, const Version& after, const Pair& pair) const;

  const std::vector<DrawnRung> before_;
  const std::vector<DrawnRung> after_;
  std::vector<uint32_t> routineBefore_;          // for each routine of the new version, the former one; RUNG_NONE: none
  std::vector<uint32_t> homeBefore_, homeAfter_; // the routine of each drawn rung
  std::vector<Pair> pairs_;
  std::vector<uint32_t> pairOf_; // for each new rung, the old one; RUNG_NONE: none
  // For each rung, the first one from it on in its routine that both versions have in the same order, by its old
  // number; RUNG_NONE: the end.
  std::vector<uint32_t> keptBefore_, keptAfter_;
};

} // namespace rung::report
