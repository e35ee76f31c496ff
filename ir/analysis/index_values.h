// Which numbers a program puts into cells that its indices come from: programs call one routine for each unit of a
// machine, and give it the unit by constants. What is found here is likely and not certain: the caller has to check it.
#pragma once
#include <span>
#include <unordered_map>
#include <vector>

#include "ir/analysis/rung_ranges.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {

// Whether an operation accesses a place by an index; whether it is a bit, whose number is the second operand.
inline bool isWindow(const Op& op) { return opInfo(op.code).attr == Attr::Window; }
inline bool isOfBit(const Op& op) { return op.code == OpCode::LoadBitAt || op.code == OpCode::StoreBitAt; }

// The cells that windows of a rung get their indices from, each once, in the order of their last use.
void findIndexCells(const Rung& rung, std::vector<Cell>& cells);

class IndexValues {
public:
  // Looks through the whole program.
  explicit IndexValues(const Module& module);

  // In the order of the program; values of one number in several cells belong together. Empty where the program puts
  // no constants into the cell, or more than a few.
  std::span<const uint64_t> of(const Cell& cell) const;

private:
  void findCells();
  void findConstants();
  void findConstants(const Rung& rung);
  bool derive();
  bool deriveFrom(const Rung& rung, size_t n, RungRanges& ranges);
  std::vector<uint64_t>* find(const Cell& cell);

  const Module& module_;
  std::unordered_map<uint64_t, std::vector<uint64_t>> values_; // by cell
  std::vector<const Rung*> storing_;                           // rungs that store one of these, in their order
};

} // namespace rung::ir
