// The constants that a program stores in cells used as indices: programs call one routine for each unit of a machine,
// and pass the unit as a constant. The result is likely, not certain: the caller has to check it.
#pragma once
#include <span>
#include <unordered_map>
#include <vector>

#include "ir/analysis/rung_ranges.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {

// Whether an operation accesses a place by an index; whether the place is a bit, whose number is the second operand.
inline bool isWindow(const Op& op) { return opInfo(op.code).attr == Attr::Window; }
inline bool isOfBit(const Op& op) { return op.code == OpCode::LoadBitAt || op.code == OpCode::StoreBitAt; }

// The cells from which windows of a rung get their indices, each once, in the order of their last use.
void findIndexCells(const Rung& rung, std::vector<Cell>& cells);

class IndexValues {
public:
  // Searches the whole program.
  explicit IndexValues(const Module& module);

  // The constants in program order; values of one position for several cells belong together. Empty if the program
  // stores no constants in the cell, or more than a few.
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
  std::vector<const Rung*> storing_;                           // rungs that store one of these, in program order
};

} // namespace rung::ir
