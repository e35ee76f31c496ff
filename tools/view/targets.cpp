// See targets.h.
#include "tools/view/targets.h"

namespace rung::view {

uint32_t Targets::idOf(const frontend::TargetUse& use) {
  const auto [found, fresh] = ids_.emplace(std::pair(use.scope, use.number), static_cast<uint32_t>(targets_.size()));
  if (fresh) targets_.emplace_back();
  return found->second;
}

void Targets::ask(uint32_t id, uint32_t rung) {
  std::vector<uint32_t>& callers = targets_[id].callers;
  if (callers.empty() || callers.back() != rung) callers.push_back(rung);
}

} // namespace rung::view
