// What decided a write of a rung in one of its runs, found in the rung's operations and the values that they had.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ir/core/module.h"
#include "ir/interp/interp.h"

namespace rung::replay {

// An operation that brought a value in: a load, the clock, an answer of the control.
struct Leaf {
  uint32_t operation = 0;
  uint32_t value = 0;   // of the rung
  bool alone = false;   // with its other value alone the outcome would have been the other one; bits only
  bool isIndex = false; // it determined the address
};

class RungReasons {
public:
  // `values` of the run; all must outlive it.
  RungReasons(const ir::Rung& rung, std::span<const uint64_t> values);

  // What decided the value that the operation stored, where, and whether it was reached: enough of it that the outcome
  // follows. In the order of the operations.
  std::vector<Leaf> of(uint32_t store) const;
  // What decided a value.
  std::vector<Leaf> ofValue(uint32_t value) const;
  // The fewest leaves that would have to have the other value for the stored bit to have the other one. Empty: no
  // number of them would do, as far as the rung shows. `fixed`: operations that cannot be among them.
  std::vector<Leaf> toChange(uint32_t store, std::span<const uint32_t> fixed) const;

private:
  class Justification;
  class Change;
  uint32_t argument(const ir::Op& op, int i) const { return ir::arg(rung_, op, i).index; }
  std::vector<Leaf> marked(std::vector<Leaf> leaves, uint32_t root) const;
  uint32_t storedValue(const ir::Op& op) const;
  static bool isLeaf(const ir::Op& op);

  const ir::Rung& rung_;
  std::span<const uint64_t> values_;
  std::vector<uint32_t> madeBy_;              // by value: the operation
  std::vector<uint32_t> begin_, else_;        // by operation that ends a region: its beginning; by beginning: its else
  std::vector<std::vector<uint32_t>> around_; // by operation: the beginnings of the regions around it
};

} // namespace rung::replay
