// See long_rungs.h.
#include "ir/core/long_rungs.h"

#include "ir/core/op_info.h"

namespace rung::ir {

// What operations have computed and another stretch uses. Numbers and what is read are in no chain.
std::vector<bool> valuesThroughMemory(const Rung& rung) {
  if (!isLong(rung)) return {};
  constexpr size_t kNone = ~size_t{0};
  std::vector<bool> through(rung.values.size());
  std::vector<size_t> stretches(rung.values.size(), kNone); // by value, where it is computed
  for (size_t i = 0; i < rung.ops.size(); ++i) {
    const Op& op = rung.ops[i];
    for (uint32_t k = 0; k < op.argCount; ++k) {
      const uint32_t value = rung.args[op.firstArg + k].index;
      through[value] = through[value] || (stretches[value] != kNone && stretches[value] != i / kStretch);
    }
    if (op.argCount == 0 || (opInfo(op.code).effects & kReads) != 0) continue;
    for (uint32_t k = 0; k < op.resultCount; ++k) stretches[op.result.index + k] = i / kStretch;
  }
  return through;
}

} // namespace rung::ir
