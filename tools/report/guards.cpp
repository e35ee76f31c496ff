// Guards of operations (see guards.h).
#include "tools/report/guards.h"

#include <algorithm>

#include "ir/core/ops.h"

namespace rung::report {

std::vector<std::vector<Guard>> guardsOf(const ir::Rung& rung) {
  std::vector<std::vector<Guard>> guards(rung.values.size());
  std::vector<Guard> open;
  for (const ir::Op& op : rung.ops) {
    if (op.code == ir::OpCode::EndIf) open.pop_back();
    if (op.code == ir::OpCode::Else) open.back().wanted = false;
    if (op.code == ir::OpCode::If) open.push_back({ir::arg(rung, op, 0).index, true});
    for (uint32_t i = 0; i < op.resultCount; ++i) guards[op.result.index + i] = open;
  }
  return guards;
}

bool reached(std::span<const Guard> guards, std::span<const uint64_t> values) {
  return std::ranges::all_of(guards, [&](const Guard& guard) { return (values[guard.value] != 0) == guard.wanted; });
}

} // namespace rung::report
