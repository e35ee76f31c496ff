// Both directions of the canonical decomposition: commands to trees and back.
#include "frontend/network/read/canonical.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
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

// Joins the two topmost groups. Groups of the same kind are merged into the left one.
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
  std::vector<std::pair<uint32_t, uint32_t>> work{{root, 0}}; // (node here, node of the copy)
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

constexpr std::string_view kBlocks = "list:";

bool isBlockCommand(Logic kind) { return kind == Logic::OrBlock || kind == Logic::AndBlock; }

// Canonical form of the commands; empty if a command lacks a value.
std::vector<Logic> canonicalLogic(std::span<const Logic> commands) {
  std::vector<Logic> result;
  if (const auto trees = treesOf(commands))
    for (const SpTree& tree : *trees)
      for (const CanonicalStep& step : canonicalSteps(tree)) result.push_back(step.kind);
  return result;
}

uint32_t depthOf(std::span<const Logic> commands) {
  uint32_t depth = 0;
  uint32_t deepest = 0;
  for (Logic kind : commands) {
    if (kind == Logic::Load) deepest = std::max(deepest, ++depth);
    if (isBlockCommand(kind)) --depth;
  }
  return deepest;
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

std::vector<std::string_view> wordsIn(std::string_view comment) {
  std::vector<std::string_view> words;
  for (std::string_view text = text::trimmed(comment); !text.empty(); text = text::trimmed(text)) {
    const size_t end = std::min(text.find_first_of(" \t"), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

std::string blocksHint(const Language& language, std::span<const Logic> commands) {
  const std::vector<Logic> canonical = canonicalLogic(commands);
  if (std::equal(canonical.begin(), canonical.end(), commands.begin(), commands.end())) return {};
  std::string text(kBlocks);
  for (Logic kind : commands) (text += ' ') += language.nameOf(commandOf(kind));
  return text;
}

std::optional<std::vector<Logic>> parseBlocksHint(const Language& language, std::string_view comment) {
  constexpr Logic kLogic[] = {Logic::Load, Logic::And, Logic::Or, Logic::OrBlock, Logic::AndBlock};
  if (!comment.starts_with(kBlocks)) return std::nullopt;
  std::vector<Logic> commands;
  for (std::string_view word : wordsIn(comment.substr(kBlocks.size()))) {
    const auto* const at = std::find_if(std::begin(kLogic), std::end(kLogic), [&](Logic kind) {
      return text::equalsIgnoringCase(language.nameOf(commandOf(kind)), word);
    });
    if (at == std::end(kLogic)) return std::nullopt;
    commands.push_back(*at);
  }
  return commands;
}

std::optional<std::vector<CanonicalStep>> withBlocks(const std::vector<CanonicalStep>& steps,
                                                     std::span<const Logic> blocks, uint32_t stackDepth) {
  std::vector<Logic> own;
  std::vector<ladder::ElementId> contacts;
  for (const CanonicalStep& step : steps) {
    own.push_back(step.kind);
    if (!isBlockCommand(step.kind)) contacts.push_back(step.contact);
  }
  if (canonicalLogic(blocks) != own || depthOf(blocks) > stackDepth) return std::nullopt;
  std::vector<CanonicalStep> result;
  size_t next = 0;
  for (Logic kind : blocks) result.push_back({kind, isBlockCommand(kind) ? ladder::ElementId{} : contacts[next++]});
  return result;
}

std::optional<std::vector<SpTree>> treesOf(std::span<const Logic> commands) {
  TreeBuilder builder;
  for (Logic kind : commands)
    if (!builder.add(kind)) return std::nullopt;
  return builder.take();
}

} // namespace rung::frontend::network
