// How often runs of a program have taken its branches, and the branch weights of its ifs that follow from that.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

// An if of a rung: how often it was reached, and how often its condition was 1.
struct Branch {
  uint64_t reached = 0;
  uint64_t taken = 0;
  bool operator==(const Branch&) const = default;
};

// By Rung::key: the ifs of a rung as its front end built it, in their order. Rungs without a key, made by the compiler,
// are not in it.
using BranchCounts = std::map<uint64_t, std::vector<Branch>>;

struct BranchWeightsResult {
  size_t known = 0;   // rungs with ifs whose counts were found
  size_t unknown = 0; // rungs without counts: new, changed, or made by another compiler
};

// Sets the branch weights of the ifs of a module that no pass has changed.
BranchWeightsResult setBranchWeights(Module& module, const BranchCounts& counts);

} // namespace rung::ir
