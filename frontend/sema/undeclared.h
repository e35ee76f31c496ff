// Uses of names that a program does not declare: one report for each name, at its first use, with what is fixed at all
// of them.
#pragma once
#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "frontend/sema/names.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend {

struct UndeclaredUse {
  std::string_view name;
  SourceRange range;
};

// The places of the uses.
template <class Use>
std::vector<SourceRange> placesOf(std::span<const Use> uses) {
  std::vector<SourceRange> places;
  for (const Use& use : uses) places.push_back(use.range);
  return places;
}

// Adds the second use, and how many there are.
void noteFurtherUses(DiagBuilder& report, SourceRange second, size_t further);

// Use is an UndeclaredUse, with what the dialect needs to know for the report. Uses may be added in any order, and
// several times.
template <class Use = UndeclaredUse, auto keyOf = asWritten>
class UndeclaredNames {
public:
  void add(Use use) {
    auto key = keyOf(use.name);
    uses_[std::move(key)].push_back(std::move(use));
  }

  // `explain` gets each report, which has the name as its first argument, and the uses, the first one first.
  template <class Explain>
  void report(Diagnostics& diagnostics, Diag code, Explain explain) {
    const auto begin = [](const Use& use) { return use.range.begin; };
    for (auto& [key, uses] : uses_) {
      std::ranges::stable_sort(uses, {}, begin);
      const auto again = std::ranges::unique(uses, {}, begin);
      uses.erase(again.begin(), again.end());
      const Use& first = uses.front();
      DiagBuilder report = diagnostics.report(code, first.range);
      report << first.name;
      explain(report, std::span<const Use>(uses));
      if (uses.size() > 1) noteFurtherUses(report, uses[1].range, uses.size() - 1);
    }
    uses_.clear();
  }

private:
  std::map<decltype(keyOf(std::string_view())), std::vector<Use>> uses_;
};

} // namespace rung::frontend
