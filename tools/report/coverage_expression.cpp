// Decisions as functions of conditions (see expression.h).
#include "tools/report/coverage_expression.h"

#include <algorithm>
#include <bit>

#include "ir/core/ops.h"

namespace rung::report {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
constexpr size_t kFlips = 63; // lane 0 flips nothing

uint64_t spread(uint64_t bit) { return bit == 0 ? 0 : ~uint64_t{0}; }

} // namespace

bool Expression::isLogic(const ir::Op& op) {
  if (op.type != ir::Type::Bit) return false;
  return op.code == ir::OpCode::And || op.code == ir::OpCode::Or || op.code == ir::OpCode::Xor ||
         op.code == ir::OpCode::Not || op.code == ir::OpCode::Select;
}

Expression::Kind Expression::kindOf(ir::OpCode code) {
  if (code == ir::OpCode::And) return Kind::And;
  if (code == ir::OpCode::Or) return Kind::Or;
  if (code == ir::OpCode::Xor) return Kind::Xor;
  return code == ir::OpCode::Not ? Kind::Not : Kind::Select;
}

// Operations come in an order in which operands are defined before they are used, so one walk upwards finds what the
// root needs, and one downwards makes the nodes.
Expression::Expression(const ir::Rung& rung, ir::ValueId root, std::span<const ir::ValueId> conditions) {
  std::vector<uint32_t> conditionOf(rung.values.size(), kNone);
  for (uint32_t i = 0; i < conditions.size(); ++i) conditionOf[conditions[i].index] = i;
  std::vector<bool> needed(rung.values.size(), false);
  needed[root.index] = true;
  const auto opens = [&](const ir::Op& op) {
    return isLogic(op) && needed[op.result.index] && conditionOf[op.result.index] == kNone;
  };
  for (size_t i = rung.ops.size(); i-- > 0;)
    if (opens(rung.ops[i]))
      for (int a = 0; a < rung.ops[i].argCount; ++a) needed[ir::arg(rung, rung.ops[i], a).index] = true;
  std::vector<uint32_t> nodeOf(rung.values.size(), kNone);
  const auto add = [&](uint32_t value, Node node) {
    nodeOf[value] = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back(node);
  };
  const auto addLeaf = [&](uint32_t value) {
    if (conditionOf[value] == kNone) return add(value, {.kind = Kind::Held, .value = value});
    add(value, {.kind = Kind::Condition, .a = static_cast<uint32_t>(conditions_.size()), .value = value});
    conditions_.push_back(conditionOf[value]);
  };
  for (const ir::Op& op : rung.ops) {
    if (opens(op)) {
      uint32_t args[3] = {};
      for (int a = 0; a < op.argCount; ++a) args[a] = nodeOf[ir::arg(rung, op, a).index];
      add(op.result.index, {.kind = kindOf(op.code), .a = args[0], .b = args[1], .c = args[2]});
      if (op.result == root) break; // it is to be the last node
      continue;
    }
    for (uint32_t r = 0; r < op.resultCount; ++r)
      if (needed[op.result.index + r]) addLeaf(op.result.index + r);
  }
}

// The root in 64 lanes; lane l flips condition first + l - 1, lane 0 none.
uint64_t Expression::evaluate(std::span<const uint64_t> values, size_t first, std::vector<uint64_t>& lanes) const {
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    uint64_t& out = lanes[i];
    switch (node.kind) {
    case Kind::Held: out = spread(values[node.value]); break;
    case Kind::Condition:
      out = spread(values[node.value]);
      if (node.a >= first && node.a < first + kFlips) out ^= uint64_t{2} << (node.a - first);
      break;
    case Kind::And: out = lanes[node.a] & lanes[node.b]; break;
    case Kind::Or: out = lanes[node.a] | lanes[node.b]; break;
    case Kind::Xor: out = lanes[node.a] ^ lanes[node.b]; break;
    case Kind::Not: out = ~lanes[node.a]; break;
    case Kind::Select: out = (lanes[node.a] & lanes[node.b]) | (~lanes[node.a] & lanes[node.c]); break;
    }
  }
  return lanes.back();
}

void Expression::findDeciding(std::span<const uint64_t> values, const std::function<void(size_t i)>& decides) const {
  std::vector<uint64_t> lanes(nodes_.size());
  for (size_t first = 0; first < conditions_.size(); first += kFlips) {
    const uint64_t result = evaluate(values, first, lanes);
    uint64_t flipped = result ^ spread(result & 1); // lanes that differ from lane 0
    for (; flipped != 0; flipped &= flipped - 1) decides(first + static_cast<size_t>(std::countr_zero(flipped)) - 1);
  }
}

} // namespace rung::report
