// What values a rung may compute, when it is known what some cells may hold before it. A cell is a fixed place of an
// integer; no other code writes it while the rung runs.
#pragma once
#include <span>
#include <vector>

#include "ir/analysis/value_range.h"
#include "ir/core/memory_use.h"
#include "ir/core/regions.h"

namespace rung::ir {

struct Cell {
  BitRange place;
  Type type = Type::I32;
  bool operator==(const Cell&) const = default;
};

// What each cell may hold, in the order of the cells.
using CellRanges = std::vector<Range>;

class RungRanges {
public:
  explicit RungRanges(const Module& module) : module_(module) {}

  // `held` says what the cells may hold before the rung, and then what they may hold after it.
  void run(const Rung& rung, std::span<const Cell> cells, CellRanges& held);

  // Of the rung that was run last; every value of the type where control does not come.
  const Range& of(ValueId value) const { return values_[value.index]; }

private:
  // An open region.
  struct Frame {
    CellRanges held; // if: before it, and from its else on what its first region leaves; loop: what no pass changes
    std::vector<Range> yields; // if: of the first region
    bool decided = false;      // if: one region does not run
  };

  uint32_t visit(uint32_t i);
  uint32_t openIf(uint32_t i);
  uint32_t turnElse(uint32_t i);
  void closeIf(const Op& op);
  void openLoop(uint32_t i);
  void closeLoop();
  void setResults(const Op& op, std::span<const Range> ranges);
  void set(ValueId value, const Range& range) { values_[value.index] = range; }
  Range load(const Op& op) const;
  Range pure(const Op& op) const;
  void store(const Op& op);
  BitRange reachOf(const Op& op, BitRange all) const;
  void forgetWrites(uint32_t first, uint32_t end);
  std::vector<Range> yieldsOf(const Op& op) const;
  const Range& argOf(const Op& op, int i) const { return of(arg(*rung_, op, i)); }

  const Module& module_;
  std::span<const Cell> cells_;
  const Rung* rung_ = nullptr;
  CellRanges* held_ = nullptr;
  std::vector<Range> values_;
  std::vector<Region> regions_;
  std::vector<Frame> open_;
};

} // namespace rung::ir
