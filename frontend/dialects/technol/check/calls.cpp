// Circles of calls (see calls.h).
#include "frontend/dialects/technol/check/calls.h"

#include <algorithm>
#include <utility>

namespace rung::frontend::technol {

// A walk that needs no deep stack; the call that closes a circle is reported.
void CallGraph::check(const Program& program) const {
  constexpr uint32_t kMaxDepth = RUNG_STACK_DEPTH - 8;
  enum : uint8_t { Unseen, Open, Done };
  std::vector<uint8_t> state(calls_.size(), Unseen);
  std::vector<uint32_t> depth(calls_.size(), 1); // of the calls below
  std::vector<std::pair<uint32_t, size_t>> path;
  for (uint32_t root = 0; root < calls_.size(); ++root) {
    if (state[root] != Unseen) continue;
    state[root] = Open;
    path.push_back({root, 0});
    while (!path.empty()) {
      const uint32_t at = path.back().first;
      if (path.back().second == calls_[at].size()) {
        state[at] = Done;
        path.pop_back();
        continue;
      }
      const Call& call = calls_[at][path.back().second];
      if (state[call.callee] == Unseen) { // this call is looked at again when the callee is done
        state[call.callee] = Open;
        path.push_back({call.callee, 0});
        continue;
      }
      ++path.back().second;
      if (state[call.callee] == Open) {
        const std::string by = at == call.callee ? "" : ", by way of " + std::string(program.procedures[at].name);
        program.diagnostics.report(Diag::RecursiveProcedure, call.range) << program.procedures[call.callee].name << by;
        continue;
      }
      depth[at] = std::max(depth[at], depth[call.callee] + 1);
      if (depth[at] == kMaxDepth)
        program.diagnostics.report(Diag::TooDeep, call.range) << "procedure calls" << kMaxDepth;
    }
  }
}

} // namespace rung::frontend::technol
