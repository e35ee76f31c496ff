// The possible values of a rung's operations, given those of some cells before it. A cell is a fixed place of an
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

// The range of each cell, in the order of the cells.
using CellRanges = std::vector<Range>;

class RungRanges {
public:
  explicit RungRanges(const Module& module) : module_(module) {}

  // `held`: the ranges of the cells before the rung, on return those after it.
  void run(const Rung& rung, std::span<const Cell> cells, CellRanges& held);

  // Of the last rung; the whole range of the type if control does not reach the value.
  const Range& of(ValueId value) const { return values_[value.index]; }

private:
  // An open region.
  struct Frame {
    CellRanges held; // if: before it, from its else on after its first region; loop: what no iteration changes
    std::vector<Range> yields; // if: of the first region
    bool decided = false;      // if: one region never runs
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
