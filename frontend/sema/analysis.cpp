// Names and places of a program's text (see analysis.h).
#include "frontend/sema/analysis.h"

#include <algorithm>

namespace rung::frontend {
namespace {

template <class Use>
SourcePos beginOf(const Use& use) {
  return use.range.begin;
}

template <class Use>
const Use* useAt(const std::vector<Use>& uses, SourceRange range) {
  const auto at = std::ranges::lower_bound(uses, range.begin, {}, beginOf<Use>);
  return at != uses.end() && at->range == range ? &*at : nullptr;
}

} // namespace

uint32_t Analysis::define(const Definition& definition) {
  definitions_.push_back(definition);
  return static_cast<uint32_t>(definitions_.size() - 1);
}

void Analysis::settle() {
  std::ranges::stable_sort(names_, {}, beginOf<NameUse>);
  std::ranges::stable_sort(operands_, {}, beginOf<OperandUse>);
  std::ranges::stable_sort(targets_, {}, beginOf<TargetUse>);
  const auto once = [](auto& uses, auto range) { // of operands that a check reads twice
    const auto again = std::ranges::unique(uses, {}, range);
    uses.erase(again.begin(), again.end());
  };
  once(names_, &NameUse::range);
  once(targets_, &TargetUse::range);
}

const OperandUse* Analysis::operandAt(SourceRange range) const { return useAt(operands_, range); }
const TargetUse* Analysis::targetAt(SourceRange range) const { return useAt(targets_, range); }

const Definition* Analysis::nameAt(SourceRange range) const {
  const NameUse* use = useAt(names_, range);
  return use == nullptr ? nullptr : &definitions_[use->definition];
}

} // namespace rung::frontend
