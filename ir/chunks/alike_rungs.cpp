// Finding rows of alike rungs (see alike_rungs.h).
#include "ir/chunks/alike_rungs.h"

#include <algorithm>
#include <span>

namespace rung::ir {
namespace {

constexpr size_t kRow = 8;          // rungs, or groups of them
constexpr size_t kLargestGroup = 4; // rungs for one alarm or pocket

bool alike(const Rung& a, const Rung& b) {
  return a.values == b.values && a.args == b.args && a.transfer.kind == TransferKind::Next &&
         b.transfer.kind == TransferKind::Next && std::ranges::equal(a.ops, b.ops, [](const Op& x, const Op& y) {
           return x.code == y.code && x.type == y.type && x.result == y.result && x.argCount == y.argCount;
         });
}

// Whether so many rungs in a row are each like the one a group above it.
bool hasRow(std::span<const Rung> rungs, size_t group) {
  size_t row = group;
  for (size_t i = group; i < rungs.size(); ++i) {
    row = alike(rungs[i - group], rungs[i]) ? row + 1 : group;
    if (row >= kRow * group) return true;
  }
  return false;
}

} // namespace

bool hasAlikeRungs(const Module& module, const Chunk& chunk) {
  const auto rungs = std::span(module.at(chunk.routine).rungs).subspan(chunk.firstRung, chunk.rungCount);
  for (size_t group = 1; group <= kLargestGroup; ++group)
    if (hasRow(rungs, group)) return true;
  return false;
}

} // namespace rung::ir
