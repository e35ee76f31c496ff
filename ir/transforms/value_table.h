// The values that a rung has so far, by what they are: an operation on operands, or what a place of memory held at
// some time. Scoped: what was entered in a region is forgotten at its end, and an older entry shows again.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

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
    uint32_t time; // when memory held it; 0 for what always holds
    uint32_t bucket;
    uint32_t below;
  };

  // Empty, for so many operations of a rung.
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

  // Where a key is or belongs; valid until the next change of the table.
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
  // The latest entry; null when there is none. Valid as long as the spot.
  const Entry* at(Spot spot) const { return spot.entry == RUNG_NONE ? nullptr : &entries_[spot.entry]; }
  // `spot` is that of `key`.
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
  std::vector<uint32_t> scopes_; // entries before each open region
};

} // namespace rung::ir
