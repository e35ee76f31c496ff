// Reuse: an operation without effects is not repeated with the same operands. A load takes the value of an earlier load
// of the same place and type, or of an earlier store, unless an operation between may have overwritten it. Values of a
// region are known within it only; writes count from where they are, whether their region runs or not; and a loop with
// any write invalidates everything that was read before it.
#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "ir/analysis/write_times.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/core/regions.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {
namespace {

// The values of a rung so far, by their keys: an operation on operands, or the contents of a place in memory at some
// time. Scoped: entries of a region are removed at its end, and an older entry becomes visible again.

struct ValueKey {
  OpCode code{};
  Type type = Type::None;
  uint32_t ref = 0;
  uint32_t count = 0;
  int64_t imm = 0;
  uint32_t args[3] = {0, 0, 0};
  bool operator==(const ValueKey&) const = default;
};

class ValueTable {
public:
  struct Entry {
    ValueKey key;
    ValueId value;
    uint32_t time; // time at which memory held it; 0 for values independent of memory
    uint32_t bucket;
    uint32_t below;
  };

  // Clears the table, for a rung with this number of operations.
  void clear(size_t operations) {
    heads_.assign(std::bit_ceil(operations + 1), RUNG_NONE);
    entries_.clear();
    scopes_.clear();
  }
  bool isInRegion() const { return !scopes_.empty(); }
  void open() { scopes_.push_back(static_cast<uint32_t>(entries_.size())); }
  void close() {
    // The entries of a chain are in order, so the last one entered is its head.
    for (; entries_.size() > scopes_.back(); entries_.pop_back())
      heads_[entries_.back().bucket] = entries_.back().below;
    scopes_.pop_back();
  }

  // Where a key is or would be; valid until the next change of the table.
  struct Spot {
    uint32_t bucket;
    uint32_t entry;
  };
  Spot find(const ValueKey& key) const {
    const uint32_t bucket = bucketOf(key);
    uint32_t at = heads_[bucket];
    while (at != RUNG_NONE && !(entries_[at].key == key)) at = entries_[at].below;
    return {bucket, at};
  }
  // The latest entry; null if there is none. Valid as long as the spot.
  const Entry* at(Spot spot) const { return spot.entry == RUNG_NONE ? nullptr : &entries_[spot.entry]; }
  // `spot` must be that of `key`.
  void enter(Spot spot, const ValueKey& key, ValueId value, uint32_t time) {
    if (spot.entry != RUNG_NONE && spot.entry >= (scopes_.empty() ? 0 : scopes_.back())) {
      entries_[spot.entry].value = value;
      entries_[spot.entry].time = time;
      return;
    }
    uint32_t& head = heads_[spot.bucket];
    entries_.push_back({key, value, time, spot.bucket, head});
    head = static_cast<uint32_t>(entries_.size()) - 1;
  }

private:
  uint32_t bucketOf(const ValueKey& key) const {
    uint64_t hash = static_cast<uint64_t>(key.imm);
    const auto mix = [&](uint64_t word) { hash = (std::rotl(hash, 27) ^ word) * 0x9E3779B97F4A7C15ull; };
    mix((uint64_t{key.ref} << 32) | (static_cast<uint64_t>(key.code) << 8) | static_cast<uint64_t>(key.type));
    mix((uint64_t{key.args[0]} << 32) | key.args[1]);
    mix((uint64_t{key.args[2]} << 32) | key.count);
    return static_cast<uint32_t>(hash >> 32) & static_cast<uint32_t>(heads_.size() - 1);
  }

  std::vector<uint32_t> heads_; // by bucket; a power of two
  std::vector<Entry> entries_;
  std::vector<uint32_t> scopes_; // number of entries before each open region
};

bool isCommutative(OpCode code) {
  return code == OpCode::Add || code == OpCode::Mul || code == OpCode::And || code == OpCode::Or ||
         code == OpCode::Xor || code == OpCode::Eq || code == OpCode::Ne || code == OpCode::FAdd ||
         code == OpCode::FMul || code == OpCode::FEq;
}

// First searches the whole rung for reusable values; only if there are some is the rung rewritten.
class Reuser {
public:
  explicit Reuser(const Module& module) : writes_(module) {}

  // Returns what is settled of the rung afterwards.
  uint8_t run(Rung& rung, uint8_t before) {
    rung_ = &rung;
    reused_.clear();
    tookFromLoop_ = false;
    same_.resize(rung.values.size());
    table_.clear(rung.ops.size());
    writes_.start(rung);
    findWritingLoops();
    for (uint32_t i = 0; i < rung.ops.size(); ++i) {
      if (isReused(i)) reused_.push_back(i);
      if (isLong(rung) && i % kStretch == 0 && !table_.isInRegion()) table_.clear(kStretch);
    }
    if (reused_.empty()) return before | kReused;
    write(rung);
    return tookFromLoop_ ? kNothingSettled : kReused;
  }

private:
  // Whether the results of operation i, or the value that it stores, exist already.
  bool isReused(uint32_t i) {
    const Op& op = rung_->ops[i];
    const OpInfo& info = opInfo(op.code);
    const uint32_t time = i + 1;
    if (onlyReads(info)) return hasResult(op, info, time);
    for (uint32_t k = 0; k < op.resultCount; ++k) same_[op.result.index + k] = {op.result.index + k};
    if ((info.effects & kWrites) != 0) return isStored(op, time);
    if (op.code == OpCode::Else || op.code == OpCode::EndIf || op.code == OpCode::EndLoop) table_.close();
    if (op.code == OpCode::If || op.code == OpCode::Else || op.code == OpCode::Loop) table_.open();
    if (op.code == OpCode::Loop && writingLoop_[i]) writes_.writeAll(time);
    return false;
  }

  bool hasResult(const Op& op, const OpInfo& info, uint32_t time) {
    const ValueKey key = keyOf(op);
    const ValueTable::Spot spot = table_.find(key);
    const ValueTable::Entry* entry = table_.at(spot);
    if (entry != nullptr && (info.effects != kReads || writes_.unchanged(op, entry->time))) {
      same_[op.result.index] = entry->value;
      return true;
    }
    same_[op.result.index] = op.result;
    table_.enter(spot, key, op.result, time);
    return false;
  }

  // Whether a store stores what its place holds already; after any other store the contents of the place are known.
  bool isStored(const Op& op, uint32_t time) {
    const bool known = op.code == OpCode::Store || op.code == OpCode::SlotStore;
    if (!known) {
      writes_.write(op, time);
      return false;
    }
    const ValueKey key = keyOf(op);
    const ValueId value = same_[arg(*rung_, op, 0).index];
    const ValueTable::Spot spot = table_.find(key);
    const ValueTable::Entry* entry = table_.at(spot);
    if (entry != nullptr && entry->value == value && writes_.unchanged(op, entry->time)) {
      tookFromLoop_ = tookFromLoop_ || hasLoop_;
      return true;
    }
    writes_.write(op, time);
    table_.enter(spot, key, value, time);
    return false;
  }

  // A store has the key of a load that reads its place.
  ValueKey keyOf(const Op& op) const {
    ValueKey key{.code = op.code, .type = op.type, .ref = op.ref, .count = op.count, .imm = op.imm, .args = {0, 0, 0}};
    if (op.code == OpCode::Store)
      key.code = OpCode::Load;
    else if (op.code == OpCode::SlotStore)
      key.code = OpCode::SlotLoad;
    else
      for (uint32_t i = 0; i < op.argCount; ++i) key.args[i] = same_[rung_->args[op.firstArg + i].index].index;
    if (isCommutative(op.code) && key.args[0] > key.args[1]) std::swap(key.args[0], key.args[1]);
    return key;
  }

  void write(Rung& rung) {
    writer_.start(rung);
    auto next = reused_.begin();
    for (uint32_t i = 0; i < rung.ops.size(); ++i) {
      const Op& op = rung.ops[i];
      if (next == reused_.end() || *next != i) {
        writer_.copy(op);
        continue;
      }
      ++next;
      if (op.resultCount != 0) writer_.replace(op.result, writer_.mapped(same_[op.result.index]));
    }
    writer_.finish(rung);
  }

  void findWritingLoops() {
    hasLoop_ = std::ranges::any_of(rung_->ops, [](const Op& op) { return op.code == OpCode::Loop; });
    if (!hasLoop_) return;
    writingLoop_.assign(rung_->ops.size(), false);
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < rung_->ops.size(); ++i) {
      const Op& op = rung_->ops[i];
      if (op.code == OpCode::Loop) {
        open.push_back(i);
      } else if (op.code == OpCode::EndLoop) {
        const bool writes = writingLoop_[open.back()];
        open.pop_back();
        if (writes && !open.empty()) writingLoop_[open.back()] = true;
      } else if (!open.empty() && (opInfo(op.code).effects & kWrites) != 0) {
        writingLoop_[open.back()] = true;
      }
    }
  }

  const Rung* rung_ = nullptr;
  std::vector<uint32_t> reused_; // operations that are not repeated
  std::vector<ValueId> same_;    // by value: the first equal one
  ValueTable table_;
  WriteTimes writes_;
  bool hasLoop_ = false;
  std::vector<bool> writingLoop_; // by operation, if there are loops: whether it is a loop with writes
  bool tookFromLoop_ = false;     // possibly a store was removed from a loop
  RungRewriter writer_;
};

} // namespace

void reuseValues(Module& module, Settled& settled) {
  Reuser reuser(module);
  settled.eachOpen(module, kReused, [&](Rung& rung, uint32_t, uint8_t before) { return reuser.run(rung, before); });
}

} // namespace rung::ir
