// Finds the stores that a chunk does when it is left (see late_stores.h).
#include "ir/chunks/late_stores.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "ir/core/eval.h"
#include "ir/core/memory_use.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"

namespace rung::ir {
namespace {

constexpr size_t kLeastPlaces = 4; // fewer: leaving the chunk costs more
constexpr size_t kMostOps = 24;    // between a stored value and the value that it follows from

// The least number of a type: what no sum, difference, product or quotient of numbers half as wide comes to.
int64_t leastOf(Type type) { return INT64_MIN >> (64 - bitWidth(type)); }

// The operations of a rung that give the values.
class Definitions {
public:
  explicit Definitions(const Rung& rung) : rung_(&rung), of_(rung.values.size(), nullptr) {
    for (const Op& op : rung.ops)
      if (op.resultCount == 1) of_[op.result.index] = &op;
  }
  const Op* of(ValueId value) const { return of_[value.index]; }
  const Rung& rung() const { return *rung_; }

  // Never the least number of its type.
  bool isWide(ValueId value) const {
    const Op* op = of(value);
    if (op == nullptr || op->argCount != 2) return false;
    const bool isResult = op->code == OpCode::Add || op->code == OpCode::Sub || op->code == OpCode::Mul ||
                          op->code == OpCode::DivS || op->code == OpCode::RemS;
    return isResult && isNarrow(arg(*rung_, *op, 0)) && isNarrow(arg(*rung_, *op, 1));
  }

private:
  // A number of half the width of its type.
  bool isNarrow(ValueId value) const {
    const Op* op = of(value);
    if (op == nullptr) return false;
    const uint32_t half = bitWidth(typeOf(*rung_, value)) / 2;
    if (op->code == OpCode::SExt) return bitWidth(typeOf(*rung_, arg(*rung_, *op, 0))) <= half;
    if (op->code != OpCode::Const || half == 0) return false;
    const int64_t number = op->imm << (64 - 2 * half) >> (64 - 2 * half);
    return number >= -(int64_t{1} << (half - 1)) && number < int64_t{1} << (half - 1);
  }

  const Rung* rung_;
  std::vector<const Op*> of_; // by value
};

// What a stored value follows from.
struct Source {
  ValueId from;               // invalid: it is a constant
  std::vector<const Op*> ops; // that compute the value from that; each before those that it needs, as it names them

  // Where the value comes from among them; `from` comes after all.
  size_t indexOf(ValueId value) const {
    return static_cast<size_t>(std::ranges::find(ops, value, &Op::result) - ops.begin());
  }
};

// Searches from a value back to the nearest one that it follows from alone, where that is wide.
class SourceSearch {
public:
  SourceSearch(const Definitions& definitions, ValueId value) : definitions_(definitions) {
    const Op* op = definitions.of(value);
    fails_ = op == nullptr;
    if (fails_) return;
    need(*op);
    while (!open_.empty() && !fails_) step();
    if (!fails_) arrange(*op);
  }
  bool found() const { return !fails_; }
  Source& source() { return source_; }

private:
  // The last operation that is open: no other one needs its value.
  void step() {
    const auto last = std::ranges::max_element(open_);
    const Op& op = **last;
    if (open_.size() == 1 && !needed_.empty() && definitions_.isWide(op.result)) {
      source_.from = op.result;
      open_.clear();
      return;
    }
    open_.erase(last);
    fails_ = !isEvaluable(opInfo(op.code)) || needed_.size() == kMostOps;
    if (fails_) return;
    needed_.push_back(&op);
    for (int k = 0; k < op.argCount; ++k) {
      const Op* other = definitions_.of(arg(definitions_.rung(), op, k));
      if (other == nullptr) fails_ = true;
      if (other != nullptr) need(*other);
    }
  }
  void need(const Op& op) {
    std::vector<const Op*>& list = op.code == OpCode::Const ? needed_ : open_;
    if (std::ranges::find(list, &op) == list.end()) list.push_back(&op);
  }

  void arrange(const Op& op) {
    if (std::ranges::find(source_.ops, &op) != source_.ops.end()) return;
    source_.ops.push_back(&op);
    for (int k = 0; k < op.argCount; ++k) {
      const ValueId value = arg(definitions_.rung(), op, k);
      if (value != source_.from) arrange(*definitions_.of(value));
    }
  }

  const Definitions& definitions_;
  std::vector<const Op*> open_;
  std::vector<const Op*> needed_;
  Source source_;
  bool fails_ = false;
};

bool areAlike(const Rung& rungA, const Source& a, const Rung& rungB, const Source& b) {
  if (a.ops.size() != b.ops.size() || a.from.valid() != b.from.valid()) return false;
  if (a.from.valid() && typeOf(rungA, a.from) != typeOf(rungB, b.from)) return false;
  for (size_t i = 0; i < a.ops.size(); ++i) {
    const Op& opA = *a.ops[i];
    const Op& opB = *b.ops[i];
    if (opA.code != opB.code || opA.type != opB.type || opA.imm != opB.imm || opA.argCount != opB.argCount)
      return false;
    for (int k = 0; k < opA.argCount; ++k)
      if (a.indexOf(arg(rungA, opA, k)) != b.indexOf(arg(rungB, opB, k))) return false;
  }
  return true;
}

} // namespace

class LateStoreFinder {
public:
  LateStoreFinder(const Module& module, const Chunk& chunk, std::span<const Exit> exits, LateStores& found)
      : module_(module), rungs_(std::span(module.at(chunk.routine).rungs).subspan(chunk.firstRung, chunk.rungCount)),
        exits_(exits), found_(found) {}

  void run() {
    if (!isClosed()) return;
    for (const Rung& rung : rungs_) findSources(rung);
    for (Cell& cell : cells_) keepCommonWay(cell);
    std::erase_if(cells_, [](const Cell& cell) { return cell.sources.size() < kLeastPlaces; });
    if (cells_.empty()) return;
    for (const Rung& rung : rungs_) findAccesses(rung);
    std::erase_if(cells_, [](const Cell& cell) { return cell.isAccessed; });
    for (const Cell& cell : cells_)
      if (!cell.isConstant()) join(cell);
    for (const Cell& cell : cells_)
      if (cell.isConstant()) join(cell);
    const size_t ways = waysOut();
    for (const std::vector<const Cell*>& group : groups_)
      if (group.front()->sources.size() > ways) write(group);
  }

private:
  // A store whose value follows from one value.
  struct Found {
    const Rung* rung;
    const Op* store;
    Source source;
  };
  struct Store {
    const Rung* rung;
    const Op* region; // what opens it; null: none
    const Op* op;
    const Source* late; // null: it is done where it is
  };
  struct Cell {
    BitRange bits;
    Type type;
    std::vector<Found> sources; // in the end those that come about in one way
    std::vector<Store> stores;  // all of them
    bool isAccessed = false;    // by others
    bool isConstant() const { return !sources.front().source.from.valid(); }
  };

  // Whether memory counts only where the chunk is left by its exits.
  bool isClosed() const {
    return std::ranges::none_of(rungs_, [](const Rung& rung) {
      return std::ranges::any_of(rung.ops, [](const Op& op) {
        const OpInfo& info = opInfo(op.code);
        return (info.effects & kTraps) != 0 || hostReads(info);
      });
    });
  }

  // Of rungs that widen numbers: others compute nothing that is wide.
  void findSources(const Rung& rung) {
    if (std::ranges::none_of(rung.ops, [](const Op& op) { return op.code == OpCode::SExt; })) return;
    const Definitions definitions(rung);
    for (const Op& op : rung.ops) {
      if (op.code != OpCode::Store || op.type == Type::F64) continue;
      SourceSearch search(definitions, arg(rung, op, 0));
      if (search.found()) cellOf(op).sources.push_back({&rung, &op, std::move(search.source())});
    }
  }

  Cell& cellOf(const Op& store) {
    const BitRange bits = useOf(module_, store)->place;
    const auto [found, isNew] = cellAt_.try_emplace({store.ref, bits.first, bits.count}, cells_.size());
    if (isNew) cells_.push_back({.bits = bits, .type = store.type, .sources = {}, .stores = {}});
    return cells_[found->second];
  }

  // Of the sources those that are alike, the most of them.
  static void keepCommonWay(Cell& cell) {
    std::vector<std::vector<size_t>> alike;
    for (size_t i = 0; i < cell.sources.size(); ++i) {
      const Found& each = cell.sources[i];
      const auto same = std::ranges::find_if(alike, [&](const std::vector<size_t>& others) {
        const Found& first = cell.sources[others.front()];
        return areAlike(*first.rung, first.source, *each.rung, each.source);
      });
      if (same == alike.end())
        alike.push_back({i});
      else
        same->push_back(i);
    }
    const std::vector<size_t>& most = std::ranges::max(alike, {}, &std::vector<size_t>::size);
    std::vector<Found> kept;
    for (const size_t i : most) kept.push_back(std::move(cell.sources[i]));
    cell.sources = std::move(kept);
  }

  void findAccesses(const Rung& rung) {
    std::vector<const Op*> regions{nullptr};
    for (const Op& op : rung.ops) {
      if (op.code == OpCode::Else || op.code == OpCode::EndIf || op.code == OpCode::EndLoop) regions.pop_back();
      if (op.code == OpCode::If || op.code == OpCode::Else || op.code == OpCode::Loop) regions.push_back(&op);
      const std::optional<Use> use = useOf(module_, op);
      if (!use) continue;
      for (Cell& cell : cells_) {
        if (!overlap(cell.bits, use->place)) continue;
        const bool isStore = op.code == OpCode::Store && use->place == cell.bits && op.type == cell.type;
        if (isStore) cell.stores.push_back({&rung, regions.back(), &op, lateSource(cell, op)});
        cell.isAccessed = cell.isAccessed || !isStore;
      }
    }
  }
  static const Source* lateSource(const Cell& cell, const Op& store) {
    const auto found = std::ranges::find(cell.sources, &store, &Found::store);
    return found == cell.sources.end() ? nullptr : &found->source;
  }

  // Where one is stored the others are, and where it is late they follow from the same value, or are constants.
  static bool isOfGroup(const Cell& cell, const std::vector<const Cell*>& group) {
    return std::ranges::equal(cell.stores, group.front()->stores, [&](const Store& a, const Store& b) {
      if (a.rung != b.rung || a.region != b.region) return false;
      if (cell.isConstant()) return b.late == nullptr || a.late != nullptr;
      return (a.late == nullptr) == (b.late == nullptr) && (a.late == nullptr || a.late->from == b.late->from);
    });
  }

  void join(const Cell& cell) {
    const auto group = std::ranges::find_if(groups_, [&](const auto& each) { return isOfGroup(cell, each); });
    if (group != groups_.end())
      group->push_back(&cell);
    else if (!cell.isConstant())
      groups_.push_back({&cell});
  }

  size_t waysOut() const {
    size_t ways = 0;
    for (const Exit& exit : exits_) {
      const auto count = [&](const Destination& to) { ways += to.inside() ? 0 : 1; };
      std::ranges::for_each(exit.targets, count);
      const bool jumps = exit.kind != TransferKind::Next && exit.kind != TransferKind::Switch;
      if (jumps) count(exit.taken);
      const bool goesOn = !jumps || exit.cond.valid();
      if (goesOn && exit.kind != TransferKind::Switch) count(exit.otherwise);
    }
    return ways;
  }

  void write(const std::vector<const Cell*>& cells) {
    const std::vector<Store>& stores = cells.front()->stores;
    const Found& example = cells.front()->sources.front();
    const ValueId from = example.source.from;
    LateStores::Group group{
        .rung = example.rung, .from = from, .never = leastOf(typeOf(*example.rung, from)), .ops = {}};
    const auto number = static_cast<uint32_t>(found_.groups_.size());
    for (size_t i = 0; i < stores.size(); ++i) {
      const Source* late = stores[i].late;
      for (const Cell* cell : cells) {
        const Store& store = cell->stores[i];
        // The first cell is none of constants, so its store comes after what is remembered.
        found_.parts_[store.op] = {.role = late != nullptr ? LateStores::Role::Remembers : LateStores::Role::Forgets,
                                   .isFirst = cell == cells.front(),
                                   .group = number,
                                   .from = late != nullptr ? late->from : ValueId{}};
        if (stores[i].op != example.store) continue;
        group.ops.push_back(store.op);
        group.ops.insert(group.ops.end(), store.late->ops.begin(), store.late->ops.end());
      }
    }
    std::ranges::sort(group.ops); // as in the rung
    group.ops.erase(std::ranges::unique(group.ops).begin(), group.ops.end());
    found_.groups_.push_back(std::move(group));
  }

  const Module& module_;
  std::span<const Rung> rungs_;
  std::span<const Exit> exits_;
  std::vector<Cell> cells_;
  std::map<std::array<uint32_t, 3>, size_t> cellAt_; // by space, first bit and number of bits, until some are dropped
  std::vector<std::vector<const Cell*>> groups_;
  LateStores& found_;
};

LateStores::LateStores(const Module& module, const Chunk& chunk, std::span<const Exit> exits) {
  LateStoreFinder(module, chunk, exits, *this).run();
}

} // namespace rung::ir
