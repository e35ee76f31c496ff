// Series-parallel reduction: a net with one entry and one exit joins its two edges in series; two edges between the
// same nets join in parallel. What is left is one edge exactly when the network is series-parallel.
#include "frontend/network/read/series_parallel.h"

#include <algorithm>
#include <unordered_map>

namespace rung::frontend::network {
namespace {

using ladder::Element;
using ladder::ElementId;
using ladder::NetId;
using Kind = SpTree::Kind;

// Position of a branch in the drawing: that of its topmost, then leftmost element.
struct Spot {
  uint32_t line = 0;
  uint32_t column = 0;
  auto operator<=>(const Spot&) const = default;
};

// A group of two; flattened after the reduction.
struct Pair {
  Kind kind = Kind::Contact;
  ElementId contact;
  uint32_t left = 0;
  uint32_t right = 0;
  Spot spot;
};

struct Edge {
  uint32_t from = 0;
  uint32_t to = 0;
  uint32_t pair = 0;
  bool alive = true;
};

class Reduction {
public:
  Reduction(const ladder::Rung& rung, NetId target)
      : rung_(rung), target_(target.index), ins_(rung.nets.size()), outs_(rung.nets.size()) {}

  std::optional<SpTree> run() {
    collect();
    while (!work_.empty()) {
      const uint32_t net = work_.back();
      work_.pop_back();
      joinSeries(net);
    }
    if (aliveEdges_ != 1) return std::nullopt;
    return flatten(edges_[onlyAlive(ins_[target_].edges)].pair);
  }

private:
  struct Side {
    std::vector<uint32_t> edges; // including dead edges
    uint32_t alive = 0;
  };

  void collect();
  void addEdge(uint32_t from, uint32_t to, uint32_t pair);
  void removeEdge(uint32_t edge);
  void joinSeries(uint32_t net);
  uint32_t join(Kind kind, uint32_t left, uint32_t right);
  void look(uint32_t net) {
    if (net != ladder::kRail.index && net != target_ && ins_[net].alive == 1 && outs_[net].alive == 1)
      work_.push_back(net);
  }
  uint32_t onlyAlive(std::vector<uint32_t>& edges) {
    while (!edges_[edges.back()].alive) edges.pop_back();
    // Dead edges may remain before the last one, which is alive.
    return edges.back();
  }
  SpTree flatten(uint32_t pair) const;
  std::vector<uint32_t> members(uint32_t pair) const;

  const ladder::Rung& rung_;
  uint32_t target_;
  std::vector<Side> ins_; // per net
  std::vector<Side> outs_;
  std::vector<Edge> edges_;
  std::vector<Pair> pairs_;
  std::unordered_map<uint64_t, uint32_t> between_; // live edge between two nets
  std::vector<uint32_t> work_;
  uint32_t aliveEdges_ = 0;
};

// Collects all contacts on paths to the target.
void Reduction::collect() {
  std::vector<bool> seen(rung_.nets.size(), false);
  std::vector<uint32_t> nets{target_};
  seen[target_] = true;
  while (!nets.empty()) {
    const uint32_t net = nets.back();
    nets.pop_back();
    for (ElementId id : rung_.driversOf(NetId{net})) {
      const Element& element = rung_.element(id);
      const uint32_t from = rung_.inputOf(element).index;
      pairs_.push_back({.contact = id, .spot = {element.line, element.column}});
      addEdge(from, net, static_cast<uint32_t>(pairs_.size()) - 1);
      if (!seen[from]) nets.push_back(from);
      seen[from] = true;
    }
  }
  for (uint32_t net = 0; net < seen.size(); ++net)
    if (seen[net]) look(net);
}

uint32_t Reduction::join(Kind kind, uint32_t left, uint32_t right) {
  pairs_.push_back(
      {.kind = kind, .left = left, .right = right, .spot = std::min(pairs_[left].spot, pairs_[right].spot)});
  return static_cast<uint32_t>(pairs_.size()) - 1;
}

void Reduction::addEdge(uint32_t from, uint32_t to, uint32_t pair) {
  const uint64_t key = (static_cast<uint64_t>(from) << 32) | to;
  const auto at = between_.find(key);
  if (at != between_.end() && edges_[at->second].alive) {
    edges_[at->second].pair = join(Kind::Parallel, edges_[at->second].pair, pair);
    look(from);
    look(to);
    return;
  }
  const auto edge = static_cast<uint32_t>(edges_.size());
  edges_.push_back({from, to, pair});
  between_[key] = edge;
  outs_[from].edges.push_back(edge);
  ins_[to].edges.push_back(edge);
  ++outs_[from].alive;
  ++ins_[to].alive;
  ++aliveEdges_;
}

void Reduction::removeEdge(uint32_t edge) {
  edges_[edge].alive = false;
  --outs_[edges_[edge].from].alive;
  --ins_[edges_[edge].to].alive;
  --aliveEdges_;
}

void Reduction::joinSeries(uint32_t net) {
  if (ins_[net].alive != 1 || outs_[net].alive != 1) return; // already joined
  const uint32_t left = onlyAlive(ins_[net].edges);
  const uint32_t right = onlyAlive(outs_[net].edges);
  removeEdge(left);
  removeEdge(right);
  addEdge(edges_[left].from, edges_[right].to, join(Kind::Series, edges_[left].pair, edges_[right].pair));
}

// The members of a group; nested groups of the same kind are flattened.
std::vector<uint32_t> Reduction::members(uint32_t pair) const {
  std::vector<uint32_t> result;
  std::vector<uint32_t> stack{pair};
  while (!stack.empty()) {
    const uint32_t at = stack.back();
    stack.pop_back();
    if (pairs_[at].kind == pairs_[pair].kind) {
      stack.push_back(pairs_[at].right);
      stack.push_back(pairs_[at].left);
    } else {
      result.push_back(at);
    }
  }
  if (pairs_[pair].kind == Kind::Parallel)
    std::sort(result.begin(), result.end(), [&](uint32_t a, uint32_t b) { return pairs_[a].spot < pairs_[b].spot; });
  return result;
}

SpTree Reduction::flatten(uint32_t root) const {
  SpTree tree;
  tree.nodes.emplace_back();
  std::vector<std::pair<uint32_t, uint32_t>> work{{root, 0}}; // (pair, node)
  while (!work.empty()) {
    const auto [pair, node] = work.back();
    work.pop_back();
    tree.nodes[node].kind = pairs_[pair].kind;
    tree.nodes[node].contact = pairs_[pair].contact;
    if (pairs_[pair].kind == Kind::Contact) continue;
    for (uint32_t member : members(pair)) {
      const auto child = static_cast<uint32_t>(tree.nodes.size());
      tree.nodes.emplace_back();
      tree.nodes[node].children.push_back(child);
      work.emplace_back(member, child);
    }
  }
  return tree;
}

} // namespace

std::optional<SpTree> decompose(const ladder::Rung& rung, NetId target) { return Reduction(rung, target).run(); }

} // namespace rung::frontend::network
