// Unsigned numbers between two bounds: what may be known of a value of a bit or an integer.
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
  // The numbers of both, and those between.
  Range joined(const Range& other) const { return {std::min(low, other.low), std::max(high, other.high)}; }
};

// Every value of a type.
inline Range wholeRange(Type type) { return {0, valueMask(type)}; }

// Of the result of an operation without effects on bits or integers. `type` is the operation's T, `first` the type of
// its first operand, `args` are as many as the row says.
Range rangeOf(const OpInfo& info, Type type, Type first, const Range* args);

} // namespace rung::ir
