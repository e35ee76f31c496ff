// The longest path: loops become nodes, the innermost first, and the rest has no loops (see code_paths.h).
#include "codegen/jit/code_paths.h"

#include <algorithm>

#include "ir/support/saturate.h"

namespace rung::codegen {
namespace {

constexpr const char* kIrregular = "control enters a loop of the machine code in two places";

// Nodes are blocks and, after those, loops.
class PathSearch {
public:
  PathSearch(const FunctionCode& code, std::vector<uint64_t> blockCosts) : code_(code), costs_(std::move(blockCosts)) {
    costs_.resize(code.blocks.size() + code.loops.size(), 0);
    members_.resize(code.loops.size() + 1);
    for (uint32_t b = 0; b < code.blocks.size(); ++b) {
      for (uint32_t loop = code.blocks[b].loop; loop != kNoLoop; loop = code.loops[loop].parent)
        members_[loop].push_back(b);
      members_.back().push_back(b);
    }
  }

  // False: the control flow is irregular.
  bool run(uint64_t& longest) {
    for (uint32_t loop = static_cast<uint32_t>(code_.loops.size()); loop-- > 0;) {
      uint64_t round = 0;
      if (!longestIn(loop, code_.loops[loop].header, round)) return false;
      costs_[code_.blocks.size() + loop] = saturatedProduct(round, code_.loops[loop].rounds);
    }
    return longestIn(kNoLoop, 0, longest);
  }

private:
  // The node of a block in a region: itself, or the loop in the region that contains it; UINT32_MAX if it is outside.
  uint32_t nodeOf(uint32_t block, uint32_t region) const {
    uint32_t node = block;
    for (uint32_t loop = code_.blocks[block].loop; loop != region; loop = code_.loops[loop].parent) {
      if (loop == kNoLoop) return UINT32_MAX;
      node = static_cast<uint32_t>(code_.blocks.size()) + loop;
    }
    return node;
  }

  // The longest path from a block of a region, which is a loop or the whole function.
  bool longestIn(uint32_t region, uint32_t entry, uint64_t& longest) {
    std::map<uint32_t, std::vector<uint32_t>> edges;
    std::map<uint32_t, uint32_t> entries; // number of edges into a node
    for (const uint32_t block : members_[region == kNoLoop ? members_.size() - 1 : region]) {
      const uint32_t from = nodeOf(block, region);
      for (const uint32_t next : code_.blocks[block].next) {
        const uint32_t to = nodeOf(next, region);
        if (to == UINT32_MAX || (region != kNoLoop && next == entry)) continue; // outside, or the next iteration
        if (to == from && to >= code_.blocks.size()) continue;
        edges[from].push_back(to);
        ++entries[to];
      }
    }
    return longestAlong(edges, entries, nodeOf(entry, region), longest);
  }

  bool longestAlong(const std::map<uint32_t, std::vector<uint32_t>>& edges, std::map<uint32_t, uint32_t>& entries,
                    uint32_t entry, uint64_t& longest) const {
    std::map<uint32_t, uint64_t> before; // the longest path to the node
    std::vector<uint32_t> ready;
    for (const auto& [node, targets] : edges) // unreachable nodes have successors, too
      if (!entries.contains(node)) ready.push_back(node);
    if (entries.contains(entry)) return false;
    if (!edges.contains(entry)) ready.push_back(entry);
    before[entry] = 0;
    size_t left = entries.size();
    while (!ready.empty()) {
      const uint32_t node = ready.back();
      ready.pop_back();
      const uint64_t length = saturatedSum(before[node], costs_[node]);
      longest = std::max(longest, length);
      const auto targets = edges.find(node);
      if (targets == edges.end()) continue;
      for (const uint32_t to : targets->second) {
        before[to] = std::max(before[to], length);
        if (--entries[to] != 0) continue;
        ready.push_back(to);
        --left;
      }
    }
    return left == 0;
  }

  const FunctionCode& code_;
  std::vector<uint64_t> costs_;                // by node
  std::vector<std::vector<uint32_t>> members_; // blocks of each loop, including its inner loops; last: all
};

} // namespace

const CodeLength& CodeLengths::of(const std::string& function) {
  if (const auto known = known_.find(function); known != known_.end()) return known->second;
  const auto found = functions_.find(function);
  if (found == functions_.end())
    return known_[function] = {.unknown = "it calls '" + function + "', whose code is not known"};
  known_[function] = {.unknown = "'" + function + "' calls itself"}; // while it is being measured
  const FunctionCode& code = found->second;
  CodeLength length{.unknown = code.unknown};
  std::vector<uint64_t> costs;
  for (const CodeBlock& block : code.blocks) {
    costs.push_back(block.instructions);
    for (const std::string& name : block.calls) {
      const CodeLength& callee = of(name);
      costs.back() = saturatedSum(costs.back(), callee.instructions);
      if (length.unknown.empty()) length.unknown = callee.unknown;
    }
  }
  for (const CodeLoop& loop : code.loops)
    if (loop.rounds == 0 && length.unknown.empty()) length.unknown = "a loop has no constant bound";
  if (length.unknown.empty() && !PathSearch(code, std::move(costs)).run(length.instructions))
    length.unknown = kIrregular;
  return known_[function] = std::move(length);
}

} // namespace rung::codegen
