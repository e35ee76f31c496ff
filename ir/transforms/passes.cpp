// The table of passes, and running them.
#include "ir/transforms/passes.h"

#include <algorithm>

namespace rung::ir {
namespace {

constexpr Pass kPasses[] = {
    {.name = "order",
     .doc = "Gives the operations of each rung one order, however the front end made them.",
     .overModule = [](Module& module) { orderOperations(module); }},
    {.name = "latches",
     .doc = "Reads what a task copies at its start where it comes from.",
     .overModule = &readSourcesOfLatches},
    {.name = "inline",
     .doc = "Puts a routine that has one caller in the place of the call.",
     .overModule = &inlineRoutines},
    {.name = "carried",
     .doc = "Marks slots as not transient whose value one run of a task, or one part of it, leaves for another.",
     .overModule = &keepCarried},
    {.name = "fold",
     .doc = "Computes constants, simplifies algebra, removes branches whose condition is known.",
     .overRungs = &foldConstants},
    {.name = "reuse",
     .doc = "Uses an equal operation, load or stored value above instead of the operation.",
     .overRungs = &reuseValues},
    {.name = "dead",
     .doc = "Removes operations whose results are not used, and regions without effect.",
     .overRungs = &removeDeadOps},
    {.name = "transient",
     .doc = "Removes stores to transient slots that no rung reads afterwards.",
     .overRungs = &removeTransientStores},
    {.name = "versions",
     .doc = "Adds versions of a rung for the likely values of its indices, each with fixed addresses.",
     .overRungs = &versionRanges},
    {.name = "instrument", .doc = "Counts and times each rung.", .overModule = &instrumentRungs, .last = true},
};

} // namespace

std::span<const Pass> allPasses() { return kPasses; }

const Pass* findPass(std::string_view name) {
  const auto* found = std::ranges::find(kPasses, name, &Pass::name);
  return found == std::end(kPasses) ? nullptr : found;
}

void PassRunner::run(const Pass& pass) {
  if (pass.overModule != nullptr) {
    pass.overModule(module_);
    settled_.reset();
  } else {
    if (!settled_) settled_.emplace(module_);
    pass.overRungs(module_, *settled_);
  }
  if (observer_) observer_(pass, module_);
}

} // namespace rung::ir
