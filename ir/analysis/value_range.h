// Ranges of unsigned numbers: what is known about a value of a bit or an integer.
#pragma once
#include <algorithm>
#include <cstdint>

#include "ir/core/eval.h"
#include "ir/core/op_info.h"

namespace rung::ir {

// Both bounds are possible.
struct Range {
  uint64_t low = 0;
  uint64_t high = 0;

  bool operator==(const Range&) const = default;
  bool isOne() const { return low == high; }
  // The smallest range that contains both.
  Range joined(const Range& other) const { return {std::min(low, other.low), std::max(high, other.high)}; }
};

// All values of a type.
inline Range wholeRange(Type type) { return {0, valueMask(type)}; }

// The range of the result of an operation without effects on bits or integers. `type` is the operation's T, `first` the
// type of its first operand, the number of `args` is that of the row.
Range rangeOf(const OpInfo& info, Type type, Type first, const Range* args);

} // namespace rung::ir
