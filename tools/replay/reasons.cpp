// Follows operations backwards (see reasons.h).
#include "tools/replay/reasons.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "tools/report/coverage_collector.h"

namespace rung::replay {

using ir::Op;
using ir::OpCode;

namespace {

constexpr uint32_t kNoOperation = UINT32_MAX;

bool isBitLogic(const Op& op) { return op.type == ir::Type::Bit; }

} // namespace

RungReasons::RungReasons(const ir::Rung& rung, std::span<const uint64_t> values)
    : rung_(rung), values_(values), madeBy_(rung.values.size(), kNoOperation), begin_(rung.ops.size(), kNoOperation),
      else_(rung.ops.size(), kNoOperation), around_(rung.ops.size()) {
  std::vector<uint32_t> open;
  for (uint32_t i = 0; i < rung.ops.size(); ++i) {
    const Op& op = rung.ops[i];
    if (op.code == OpCode::EndIf || op.code == OpCode::EndLoop) {
      begin_[i] = open.back();
      open.pop_back();
    }
    if (op.code == OpCode::Else) {
      else_[open.back()] = i;
      begin_[i] = open.back();
    }
    around_[i] = open;
    for (uint32_t r = 0; r < op.resultCount; ++r) madeBy_[op.result.index + r] = i;
    if (op.code == OpCode::If || op.code == OpCode::Loop) open.push_back(i);
  }
}

uint32_t RungReasons::storedValue(const Op& op) const { return argument(op, op.argCount - 1); }

bool RungReasons::isLeaf(const Op& op) {
  switch (op.code) {
  case OpCode::Load:
  case OpCode::LoadAt:
  case OpCode::LoadBitAt:
  case OpCode::SlotLoad:
  case OpCode::Now:
  case OpCode::ServiceRequest:
  case OpCode::ServicePoll:
  case OpCode::ServiceResult: return true;
  default: return false;
  }
}

// ---- what decided ------------------------------------------------------------------------------------------------

class RungReasons::Justification {
public:
  explicit Justification(const RungReasons& of) : of_(of), seen_(of.rung_.values.size(), false) {}

  void value(uint32_t value) {
    if (seen_[value]) return;
    seen_[value] = true;
    const uint32_t made = of_.madeBy_[value];
    if (made != kNoOperation) operation(made, value);
  }
  // Whether an operation was reached.
  void reached(uint32_t operation) {
    for (const uint32_t begin : of_.around_[operation]) {
      const Op& op = of_.rung_.ops[begin];
      if (op.code == OpCode::If) value(of_.argument(op, 0));
    }
  }
  void index(uint32_t value) {
    const bool before = std::exchange(indexing_, true);
    this->value(value);
    indexing_ = before;
  }

  std::vector<Leaf> leaves;

private:
  void operation(uint32_t index, uint32_t result) {
    const Op& op = of_.rung_.ops[index];
    const auto arg = [&](int i) { return of_.argument(op, i); };
    const auto on = [&](int i) { return of_.values_[arg(i)] != 0; };
    if (isLeaf(op)) {
      leaves.push_back({.operation = index, .value = result, .isIndex = indexing_});
      if (op.code == OpCode::LoadAt || op.code == OpCode::LoadBitAt)
        for (int i = 0; i < op.argCount; ++i) this->index(arg(i));
      return;
    }
    if (op.code == OpCode::EndIf) return yielded(index, result - op.result.index);
    if (op.code == OpCode::Loop || op.code == OpCode::EndLoop) return loop(index);
    const bool logic = isBitLogic(op) && (op.code == OpCode::And || op.code == OpCode::Or);
    if (logic && on(0) != on(1)) { // one of them is enough
      const bool wanted = op.code == OpCode::Or;
      return value(on(0) == wanted ? arg(0) : arg(1));
    }
    if (op.code == OpCode::Select) {
      value(arg(0));
      return value(on(0) ? arg(1) : arg(2));
    }
    for (int i = 0; i < op.argCount; ++i) value(arg(i));
  }
  void yielded(uint32_t end, uint32_t number) {
    const uint32_t begin = of_.begin_[end];
    const uint32_t condition = of_.argument(of_.rung_.ops[begin], 0);
    value(condition);
    const bool taken = of_.values_[condition] != 0;
    const uint32_t from = taken && of_.else_[begin] != kNoOperation ? of_.else_[begin] : end;
    value(of_.argument(of_.rung_.ops[from], static_cast<int>(number)));
  }
  // All that a loop takes in.
  void loop(uint32_t index) {
    const uint32_t begin = of_.rung_.ops[index].code == OpCode::Loop ? index : of_.begin_[index];
    for (uint32_t i = begin; i < of_.rung_.ops.size(); ++i) {
      const Op& op = of_.rung_.ops[i];
      const bool inside = i == begin || std::ranges::find(of_.around_[i], begin) != of_.around_[i].end();
      if (!inside && i != index) continue;
      for (int a = 0; a < op.argCount; ++a) value(of_.argument(op, a));
      if (isLeaf(op)) value(op.result.index);
    }
  }

  const RungReasons& of_;
  std::vector<bool> seen_;
  bool indexing_ = false;
};

std::vector<Leaf> RungReasons::of(uint32_t store) const {
  const Op& op = rung_.ops[store];
  Justification all(*this);
  all.value(storedValue(op));
  all.reached(store);
  for (int i = 0; i + 1 < op.argCount; ++i) all.index(argument(op, i));
  return marked(std::move(all.leaves), storedValue(op));
}

std::vector<Leaf> RungReasons::ofValue(uint32_t value) const {
  Justification all(*this);
  all.value(value);
  return marked(std::move(all.leaves), value);
}

// In order, with the bits that decided alone.
std::vector<Leaf> RungReasons::marked(std::vector<Leaf> leaves, uint32_t root) const {
  std::ranges::sort(leaves, {}, &Leaf::operation);
  if (ir::typeOf(rung_, ir::ValueId{root}) != ir::Type::Bit) return leaves;
  std::vector<ir::ValueId> bits;
  std::vector<Leaf*> which;
  for (Leaf& leaf : leaves) {
    if (ir::typeOf(rung_, ir::ValueId{leaf.value}) != ir::Type::Bit) continue;
    bits.push_back(ir::ValueId{leaf.value});
    which.push_back(&leaf);
  }
  const report::Expression expression(rung_, ir::ValueId{root}, bits);
  expression.findDeciding(values_, [&](size_t i) { which[expression.conditions()[i]]->alone = true; });
  return leaves;
}

// ---- what would have to change -----------------------------------------------------------------------------------

class RungReasons::Change {
public:
  Change(const RungReasons& of, std::span<const uint32_t> fixed) : of_(of), fixed_(fixed) {}

  using Way = std::optional<std::vector<uint32_t>>; // values of leaves
  // So that the bit has its other value.
  Way flip(uint32_t value) {
    if (const auto known = known_.find(value); known != known_.end()) return known->second;
    known_[value] = std::nullopt; // meanwhile
    Way way = found(value);
    known_[value] = way;
    return way;
  }

private:
  static Way fewer(Way a, Way b) {
    if (!a) return b;
    return !b || a->size() <= b->size() ? a : b;
  }
  static Way both(Way a, const Way& b) {
    if (!a || !b) return std::nullopt;
    for (const uint32_t value : *b)
      if (std::ranges::find(*a, value) == a->end()) a->push_back(value);
    return a;
  }
  Way found(uint32_t value) {
    const uint32_t made = of_.madeBy_[value];
    if (made == kNoOperation) return std::nullopt;
    const Op& op = of_.rung_.ops[made];
    if (ir::typeOf(of_.rung_, ir::ValueId{value}) != ir::Type::Bit || op.code == OpCode::Const) return std::nullopt;
    const auto arg = [&](int i) { return of_.argument(op, i); };
    const auto on = [&](int i) { return of_.values_[arg(i)] != 0; };
    const bool isOn = of_.values_[value] != 0;
    if (isBitLogic(op)) {
      switch (op.code) {
      case OpCode::Not: return flip(arg(0));
      case OpCode::Xor: return fewer(flip(arg(0)), flip(arg(1)));
      case OpCode::And:
      case OpCode::Or: {
        const bool one = isOn == (op.code == OpCode::And); // one of the operands suffices
        if (one) return fewer(flip(arg(0)), flip(arg(1)));
        Way way = std::vector<uint32_t>();
        for (int i = 0; i < 2; ++i)
          if (on(i) == isOn) way = both(std::move(way), flip(arg(i)));
        return way;
      }
      case OpCode::Select: {
        const int taken = on(0) ? 1 : 2, other = on(0) ? 2 : 1;
        return fewer(flip(arg(taken)), on(other) != isOn ? flip(arg(0)) : std::nullopt);
      }
      default: break;
      }
    }
    if (op.code == OpCode::EndIf) return yielded(made, value - op.result.index, isOn);
    if (std::ranges::find(fixed_, made) != fixed_.end()) return std::nullopt;
    return std::vector<uint32_t>{value}; // a load, or the result of a comparison
  }
  Way yielded(uint32_t end, uint32_t number, bool isOn) {
    const uint32_t begin = of_.begin_[end];
    const uint32_t condition = of_.argument(of_.rung_.ops[begin], 0);
    const uint32_t otherwise = of_.else_[begin];
    const bool taken = of_.values_[condition] != 0;
    const auto from = [&](bool first) {
      const uint32_t at = first && otherwise != kNoOperation ? otherwise : end;
      return of_.argument(of_.rung_.ops[at], static_cast<int>(number));
    };
    Way way = flip(from(taken));
    if (otherwise == kNoOperation) return way;
    const std::optional<bool> other = known(from(!taken), begin);
    return other && *other != isOn ? fewer(way, flip(condition)) : way;
  }
  // The value of a bit where the branch of `begin` was not taken: nothing for one that is computed in it.
  std::optional<bool> known(uint32_t value, uint32_t begin) const {
    const uint32_t made = of_.madeBy_[value];
    if (made == kNoOperation) return std::nullopt;
    if (of_.rung_.ops[made].code == OpCode::Const) return of_.rung_.ops[made].imm != 0;
    const std::vector<uint32_t>& around = of_.around_[made];
    if (std::ranges::find(around, begin) != around.end()) return std::nullopt;
    return of_.values_[value] != 0;
  }

  const RungReasons& of_;
  std::span<const uint32_t> fixed_;
  std::map<uint32_t, Way> known_;
};

std::vector<Leaf> RungReasons::toChange(uint32_t store, std::span<const uint32_t> fixed) const {
  const Change::Way way = Change(*this, fixed).flip(storedValue(rung_.ops[store]));
  std::vector<Leaf> leaves;
  if (!way) return leaves;
  for (const uint32_t value : *way) leaves.push_back({.operation = madeBy_[value], .value = value});
  return leaves;
}

} // namespace rung::replay
