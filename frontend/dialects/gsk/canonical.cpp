// Both directions of the canonical decomposition.
#include "frontend/dialects/gsk/canonical.h"

#include <iterator>
#include <utility>

namespace rung::gsk {
namespace {

using Group = SpTree::Kind;

class TreeBuilder {
public:
  bool add(Logic kind) {
    if (kind == Logic::OrBlock || kind == Logic::AndBlock)
      return block(kind == Logic::OrBlock ? Group::Parallel : Group::Series);
    const auto leaf = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({.contact = ladder::ElementId{contacts_++}});
    if (kind != Logic::Load && stack_.empty()) return false;
    stack_.push_back(leaf);
    return kind == Logic::Load || block(kind == Logic::Or ? Group::Parallel : Group::Series);
  }

  std::vector<SpTree> take() const {
    std::vector<SpTree> result;
    for (uint32_t root : stack_) result.push_back(copy(root));
    return result;
  }

private:
  bool block(Group kind);
  SpTree copy(uint32_t root) const;

  std::vector<SpTree::Node> nodes_;
  std::vector<uint32_t> stack_;
  uint32_t contacts_ = 0;
};

// Groups of the same kind are one group; the left one grows.
bool TreeBuilder::block(Group kind) {
  if (stack_.size() < 2) return false;
  const uint32_t right = stack_.back();
  stack_.pop_back();
  uint32_t& left = stack_.back();
  if (nodes_[left].kind != kind) {
    nodes_.push_back({.kind = kind, .children = {left}});
    left = static_cast<uint32_t>(nodes_.size()) - 1;
  }
  std::vector<uint32_t>& children = nodes_[left].children;
  if (nodes_[right].kind == kind)
    children.insert(children.end(), nodes_[right].children.begin(), nodes_[right].children.end());
  else
    children.push_back(right);
  return true;
}

SpTree TreeBuilder::copy(uint32_t root) const {
  SpTree tree;
  tree.nodes.emplace_back();
  std::vector<std::pair<uint32_t, uint32_t>> work{{root, 0}}; // here, in the copy
  while (!work.empty()) {
    const auto [from, to] = work.back();
    work.pop_back();
    tree.nodes[to].kind = nodes_[from].kind;
    tree.nodes[to].contact = nodes_[from].contact;
    for (uint32_t child : nodes_[from].children) {
      const auto place = static_cast<uint32_t>(tree.nodes.size());
      tree.nodes.emplace_back();
      tree.nodes[to].children.push_back(place);
      work.emplace_back(child, place);
    }
  }
  return tree;
}

} // namespace

std::vector<CanonicalStep> canonicalSteps(const SpTree& tree) {
  struct Work {
    uint32_t node = kNone; // kNone: `how` is a block command
    Logic how = Logic::Load;
  };
  std::vector<CanonicalStep> steps;
  std::vector<Work> stack{{tree.root, Logic::Load}};
  while (!stack.empty()) {
    const Work work = stack.back();
    stack.pop_back();
    if (work.node == kNone || tree.nodes[work.node].kind == Group::Contact) {
      steps.push_back({work.how, work.node == kNone ? ladder::ElementId{} : tree.nodes[work.node].contact});
      continue;
    }
    const SpTree::Node& node = tree.nodes[work.node];
    if (work.how == Logic::Or) stack.push_back({kNone, Logic::OrBlock});
    if (work.how == Logic::And) stack.push_back({kNone, Logic::AndBlock});
    const Logic further = node.kind == Group::Series ? Logic::And : Logic::Or;
    for (size_t i = node.children.size(); i-- > 1;) stack.push_back({node.children[i], further});
    stack.push_back({node.children[0], Logic::Load});
  }
  return steps;
}

std::optional<std::vector<SpTree>> treesOf(std::span<const Logic> commands) {
  TreeBuilder builder;
  for (Logic kind : commands)
    if (!builder.add(kind)) return std::nullopt;
  return builder.take();
}

} // namespace rung::gsk
