// Pairs the operations that open and close regions.
#include "ir/core/regions.h"

#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {

bool findRegions(const Rung& rung, std::vector<Region>& regions) {
  regions.resize(rung.ops.size());
  std::vector<uint32_t> open; // the operation that began the region: if, else or loop
  bool any = false;
  for (uint32_t i = 0; i < rung.ops.size(); ++i) {
    const OpCode code = rung.ops[i].code;
    const bool opens = code == OpCode::If || code == OpCode::Else || code == OpCode::Loop;
    const bool closes = code == OpCode::Else || code == OpCode::EndIf || code == OpCode::EndLoop;
    if (!opens && !closes) continue;
    any = true;
    regions[i] = {i, i};
    if (closes) {
      regions[open.back()].end = i;
      regions[i].begin = regions[open.back()].begin;
      open.pop_back();
    }
    if (opens) open.push_back(i);
  }
  return any;
}

// Results of operations that another stretch uses. Constants and loads are not part of a chain.
std::vector<bool> valuesThroughMemory(const Rung& rung) {
  if (!isLong(rung)) return {};
  constexpr size_t kNone = ~size_t{0};
  std::vector<bool> through(rung.values.size());
  std::vector<size_t> stretches(rung.values.size(), kNone); // by value: the stretch that computes it
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
