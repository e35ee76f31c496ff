// Circles and depth of calls (see calls.h).
#include "frontend/dialects/technol/check/calls.h"

#include <algorithm>

#include "ir/support/diag/source.h"
#include "ir/support/diag/technol.h"

namespace rung::frontend::technol {

void ProcedureCalls::check(const SourceProgram& program, Diagnostics& diagnostics) const {
  const CallGraph::Order order = graph_.order();
  const auto nameOf = [&](uint32_t procedure) { return std::string(program.procedures[procedure].name); };
  for (const CallGraph::Circle& circle : order.circles)
    diagnostics.report(diag::RecursiveProcedure, circle.call.range)
        << program.procedures[circle.call.callee].name << CallGraph::throughText(circle, nameOf);
  if (order.circles.empty()) checkDepth(order.calleesFirst, diagnostics);
}

void ProcedureCalls::checkDepth(std::span<const uint32_t> calleesFirst, Diagnostics& diagnostics) const {
  constexpr uint32_t kMaxDepth = RUNG_STACK_DEPTH - 8;
  std::vector<uint32_t> depth(calleesFirst.size(), 1); // of the calls below
  for (const uint32_t caller : calleesFirst)
    for (const CallGraph::Call& call : graph_.of(caller)) {
      depth[caller] = std::max(depth[caller], depth[call.callee] + 1);
      if (depth[caller] == kMaxDepth) diagnostics.report(diag::TooDeep, call.range) << "procedure calls" << kMaxDepth;
    }
}

} // namespace rung::frontend::technol
