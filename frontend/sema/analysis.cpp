// Names and places of a program's text (see analysis.h).
#include "frontend/sema/analysis.h"

#include <algorithm>

namespace rung::frontend {
namespace {

template <class Use>
SourcePos beginOf(const Use& use) {
  return use.range.begin;
}

} // namespace

uint32_t Analysis::define(const Definition& definition) {
  definitions_.push_back(definition);
  return static_cast<uint32_t>(definitions_.size() - 1);
}

void Analysis::settle() {
  std::ranges::stable_sort(names_, {}, beginOf<NameUse>);
  std::ranges::stable_sort(operands_, {}, beginOf<OperandUse>);
  const auto again = std::ranges::unique(names_, {}, &NameUse::range); // of operands that a check reads twice
  names_.erase(again.begin(), again.end());
}

const OperandUse* Analysis::operandAt(SourceRange range) const {
  const auto at = std::ranges::lower_bound(operands_, range.begin, {}, beginOf<OperandUse>);
  return at != operands_.end() && at->range == range ? &*at : nullptr;
}

const Definition* Analysis::nameAt(SourceRange range) const {
  const auto at = std::ranges::lower_bound(names_, range.begin, {}, beginOf<NameUse>);
  return at != names_.end() && at->range == range ? &definitions_[at->definition] : nullptr;
}

} // namespace rung::frontend
