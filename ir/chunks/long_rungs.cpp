// See long_rungs.h.
#include "ir/chunks/long_rungs.h"

#include "ir/core/ops.h"

namespace rung::ir {
namespace {

constexpr size_t kLongRung = 4096; // operations
constexpr size_t kStretch = 256;   // operations that a chain may have

} // namespace

// Those that are used in another stretch than their own. Numbers are no part of a chain.
std::vector<bool> valuesThroughMemory(const Rung& rung) {
  if (rung.ops.size() < kLongRung) return {};
  std::vector<bool> through(rung.values.size());
  std::vector<size_t> stretches(rung.values.size()); // by value, where it comes from
  for (size_t i = 0; i < rung.ops.size(); ++i) {
    const Op& op = rung.ops[i];
    const size_t stretch = i / kStretch;
    for (uint32_t k = 0; k < op.resultCount; ++k) stretches[op.result.index + k] = stretch;
    if (op.code == OpCode::Const) continue;
    for (uint32_t k = 0; k < op.argCount; ++k) {
      const uint32_t value = rung.args[op.firstArg + k].index;
      through[value] = through[value] || stretches[value] != stretch;
    }
  }
  return through;
}

} // namespace rung::ir
