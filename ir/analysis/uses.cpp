// Uses of memory and the flow between rungs (see uses.h).
#include "ir/analysis/uses.h"

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/hash.h"

namespace rung::ir {
namespace {

template <class T>
bool contains(const std::vector<T>& list, const T& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

template <class T>
void addOnce(std::vector<T>& list, const T& item) {
  if (!contains(list, item)) list.push_back(item);
}

bool anyMeets(const std::vector<SpaceSpan>& spans, const BitRange& place) {
  return std::ranges::any_of(spans, [&](const SpaceSpan& span) { return overlap(bitsOf(span), place); });
}

// The constant part of an index or a bit's number, to which the rest is added at run time.
std::optional<int64_t> constantPart(const Rung& rung, std::span<const Op* const> definitions, ValueId value) {
  const Op* op = definitions[value.index];
  if (op == nullptr) return std::nullopt;
  if (op->code == OpCode::Const) return static_cast<int32_t>(op->imm);
  if (op->code != OpCode::Add) return std::nullopt;
  for (int i = 0; i < 2; ++i) {
    const Op* part = definitions[arg(rung, *op, i).index];
    if (part != nullptr && part->code == OpCode::Const) return static_cast<int32_t>(part->imm);
  }
  return std::nullopt;
}

BitRange elementOf(const Module& module, const Rung& rung, std::span<const Op* const> definitions, const Op& op,
                   const Use& use) {
  const std::optional<int64_t> index = constantPart(rung, definitions, arg(rung, op, 0));
  if (!use.computed || !index) return use.place;
  const uint32_t unit = module.at(use.place.space).unitBytes * 8;
  const int64_t first = use.place.first + *index * unit;
  if (first < 0 || first + unit > int64_t{module.at(use.place.space).units} * unit) return use.place;
  BitRange element{use.place.space, static_cast<uint32_t>(first), std::max(unit, bitWidth(op.type))};
  if (op.type != Type::Bit) return {element.space, element.first, bitWidth(op.type)};
  const std::optional<int64_t> bit = constantPart(rung, definitions, arg(rung, op, 1));
  if (bit && *bit >= 0 && *bit < unit) return {element.space, element.first + static_cast<uint32_t>(*bit), 1};
  return element;
}

bool isSelect(const Op& op) { return op.code == OpCode::Select; }

// For each operation, whether it loads a value that a store writes back if a select suppresses the new one.
class KeptLoads {
public:
  explicit KeptLoads(const Rung& rung) : rung_(rung) {
    if (std::ranges::none_of(rung.ops, isSelect)) return;
    users_.resize(rung.values.size());
    for (const Op& op : rung.ops)
      for (int i = 0; i < op.argCount; ++i) use(arg(rung, op, i), &op);
    for (const ValueId value : {rung.transfer.cond, rung.transfer.value})
      if (value.valid()) use(value, nullptr);
  }

  bool contains(const Op& load) const {
    if (users_.empty() || load.code != OpCode::Load) return false;
    const Op* select = onlyUser(load.result);
    if (select == nullptr || !isSelect(*select) || arg(rung_, *select, 0) == load.result) return false;
    const Op* store = onlyUser(select->result);
    return store != nullptr && store->code == OpCode::Store && store->ref == load.ref && store->imm == load.imm;
  }

private:
  struct Users {
    uint32_t count = 0;
    const Op* last = nullptr;
  };
  void use(ValueId value, const Op* user) {
    ++users_[value.index].count;
    users_[value.index].last = user;
  }
  const Op* onlyUser(ValueId value) const {
    const Users& users = users_[value.index];
    return users.count == 1 ? users.last : nullptr;
  }

  const Rung& rung_;
  std::vector<Users> users_; // by value; empty if the rung has no select
};

struct UseHash {
  size_t operator()(const RungUse& use) const {
    const uint64_t place = hashNumber(uint64_t{use.place.space.index} << 32 | use.place.first, kHashSeed);
    return hashNumber(uint64_t{use.element.first} << 1 | (use.writes ? 1 : 0), place);
  }
};

// Adds each use once. For few uses a linear search is fastest; a long rung has thousands.
class OnceEach {
public:
  explicit OnceEach(std::vector<RungUse>& list) : list_(list) {}

  void add(const RungUse& use) {
    if (list_.size() == kFew && known_.empty()) known_.insert(list_.begin(), list_.end());
    if (list_.size() < kFew ? !contains(list_, use) : known_.insert(use).second) list_.push_back(use);
  }
  // If the rung also reads a place for other purposes, only that use is kept.
  void settle() {
    std::erase_if(list_, [&](const RungUse& use) {
      RungUse plain = use;
      plain.keeps = false;
      return use.keeps && (known_.empty() ? contains(list_, plain) : known_.contains(plain));
    });
  }

private:
  static constexpr size_t kFew = 64;
  std::vector<RungUse>& list_;
  std::unordered_set<RungUse, UseHash> known_;
};

} // namespace

Uses::RungFacts Uses::factsOf(const Module& module, const Rung& rung) {
  RungFacts facts;
  OnceEach uses(facts.uses);
  const KeptLoads kept(rung);
  for (const auto& [space, bit] : rung.constantBits) {
    const BitRange place{space, bit, 1};
    uses.add({{.place = place, .type = Type::Bit}, place});
  }
  std::vector<const Op*> definitions(rung.values.size(), nullptr);
  for (const Op& op : rung.ops) {
    if (op.resultCount == 1) definitions[op.result.index] = &op;
    if (const auto use = useOf(module, op))
      uses.add({*use, use->computed ? elementOf(module, rung, definitions, op, *use) : use->place, kept.contains(op)});
  }
  uses.settle();
  const Transfer& transfer = rung.transfer;
  facts.kind = transfer.kind;
  facts.conditional = transfer.cond.valid();
  facts.callee = transfer.callee;
  if (transfer.kind == TransferKind::Goto) facts.targets = {transfer.target};
  if (transfer.kind == TransferKind::Switch) facts.targets = transfer.targets;
  return facts;
}

Uses::Uses(const Module& module) : cleared_(module.safeSpans), retained_(module.retains) {
  for (uint32_t r = 0; r < module.routines.size(); ++r) {
    const auto first = static_cast<uint32_t>(rungs_.size());
    firstRung_.push_back(first);
    for (const Rung& rung : module.routines[r].rungs) {
      RungFacts& facts = rungs_.emplace_back(factsOf(module, rung));
      facts.routine = {r};
      for (uint32_t& target : facts.targets) target += first;
    }
  }
  for (const Task& task : module.tasks) {
    copies_.insert(copies_.end(), task.begin.begin(), task.begin.end());
    copies_.insert(copies_.end(), task.end.begin(), task.end.end());
  }
}

Uses::Writers Uses::writersOf(const BitRange& place) const {
  Writers writers;
  for (uint32_t rung = 0; rung < rungCount(); ++rung) {
    bool certain = false;
    bool computed = false;
    for (const Use& use : rungs_[rung].uses) {
      if (!use.writes || !overlap(use.place, place)) continue;
      (use.computed ? computed : certain) = true;
    }
    if (certain)
      writers.certain.push_back(rung);
    else if (computed)
      writers.computed.push_back(rung);
  }
  return writers;
}

std::vector<BitRange> Uses::copiedFrom(const BitRange& place) const {
  std::vector<BitRange> sources;
  for (const Copy& copy : copies_) {
    const BitRange to = targetOf(copy);
    if (!overlap(to, place)) continue;
    const uint32_t first = std::max(to.first, place.first);
    const uint32_t end = std::min(to.first + to.count, place.first + place.count);
    addOnce(sources, BitRange{copy.from.space, bitsOf(copy.from).first + first - to.first, end - first});
  }
  return sources;
}

std::vector<BitRange> Uses::copiedTo(const BitRange& place) const {
  std::vector<BitRange> targets;
  for (const Copy& copy : copies_) {
    const BitRange from = bitsOf(copy.from);
    if (!overlap(from, place)) continue;
    const uint32_t first = std::max(from.first, place.first);
    const uint32_t end = std::min(from.first + from.count, place.first + place.count);
    addOnce(targets, BitRange{copy.to, copy.toByte * 8 + first - from.first, end - first});
  }
  return targets;
}

std::optional<BitRange> Uses::copiedWhole(const BitRange& place) const {
  for (const Copy& copy : copies_) {
    const BitRange from = bitsOf(copy.from);
    if (copy.masked || from.space != place.space || place.first < from.first) continue;
    const uint32_t distance = place.first - from.first;
    if (distance + place.count <= from.count) return BitRange{copy.to, copy.toByte * 8 + distance, place.count};
  }
  return std::nullopt;
}

bool Uses::isCleared(const BitRange& place) const { return anyMeets(cleared_, place); }
bool Uses::isRetained(const BitRange& place) const { return anyMeets(retained_, place); }

// Whether the rung jumps to a rung after `above` and up to `upTo`.
bool Uses::jumpsBetween(uint32_t rung, uint32_t above, uint32_t upTo) const {
  return std::ranges::any_of(rungs_[rung].targets, [&](uint32_t target) { return target > above && target <= upTo; });
}

std::vector<uint32_t> Uses::decidersOf(uint32_t rung) const {
  std::vector<uint32_t> deciders;
  const uint32_t first = firstOf(rung);
  uint32_t from = rung; // first rung from which control falls through to `rung`
  for (; from > first; --from) {
    const uint32_t r = from - 1;
    const RungFacts& facts = rungs_[r];
    if (facts.kind == TransferKind::Next || facts.kind == TransferKind::Call) continue;
    if (facts.kind != TransferKind::Switch && jumpsBetween(r, r, rung)) continue; // it only skips rungs before `rung`
    if (!facts.conditional) break;
    if (facts.kind != TransferKind::Goto || facts.targets[0] > r) deciders.push_back(r); // otherwise it is a loop
  }
  if (from == first) return deciders;
  // Control does not fall through to here: the jumps to it decide.
  for (uint32_t r = rung; r-- > first;)
    if (r < from && jumpsBetween(r, from - 1, rung)) deciders.push_back(r);
  for (uint32_t r = rung + 1; r < rungCount() && rungs_[r].routine == rungs_[rung].routine; ++r)
    if (jumpsBetween(r, from - 1, rung)) deciders.push_back(r);
  return deciders;
}

std::vector<uint32_t> Uses::callersOf(uint32_t rung) const {
  std::vector<uint32_t> callers;
  for (uint32_t r = 0; r < rungCount(); ++r)
    if (calls(r) && rungs_[r].callee == rungs_[rung].routine) callers.push_back(r);
  return callers;
}

} // namespace rung::ir
