// The values that a rung has so far, by what they are: an operation on operands, or what a place of memory held at
// some time. Scoped: what was entered in a region is forgotten at its end, and an older entry shows again.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

struct ValueKey {
  OpCode code = OpCode::Const;
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
    uint32_t below;
  };

  // Empty, for a rung of so many operations.
  void clear(size_t operations) {
    heads_.assign(std::bit_ceil(operations + 1), RUNG_NONE);
    entries_.clear();
    scopes_.clear();
  }
  void open() { scopes_.push_back(static_cast<uint32_t>(entries_.size())); }
  void close() {
    // The entries of a chain are in order, so the last one entered is its head.
    for (; entries_.size() > scopes_.back(); entries_.pop_back())
      heads_[bucket(entries_.back().key)] = entries_.back().below;
    scopes_.pop_back();
  }

  // The latest entry; null when there is none. Valid until the next `enter`.
  const Entry* find(const ValueKey& key) const {
    const uint32_t at = indexOf(key);
    return at == RUNG_NONE ? nullptr : &entries_[at];
  }
  void enter(const ValueKey& key, ValueId value, uint32_t time) {
    const uint32_t at = indexOf(key);
    if (at != RUNG_NONE && at >= (scopes_.empty() ? 0 : scopes_.back())) {
      entries_[at].value = value;
      entries_[at].time = time;
      return;
    }
    uint32_t& head = heads_[bucket(key)];
    entries_.push_back({key, value, time, head});
    head = static_cast<uint32_t>(entries_.size()) - 1;
  }

private:
  size_t bucket(const ValueKey& key) const {
    uint64_t hash = static_cast<uint64_t>(key.imm);
    const auto mix = [&](uint64_t word) { hash = (std::rotl(hash, 27) ^ word) * 0x9E3779B97F4A7C15ull; };
    mix((uint64_t{key.ref} << 32) | (static_cast<uint64_t>(key.code) << 8) | static_cast<uint64_t>(key.type));
    mix((uint64_t{key.args[0]} << 32) | key.args[1]);
    mix((uint64_t{key.args[2]} << 32) | key.count);
    return (hash >> 32) & (heads_.size() - 1);
  }
  uint32_t indexOf(const ValueKey& key) const {
    uint32_t at = heads_[bucket(key)];
    while (at != RUNG_NONE && !(entries_[at].key == key)) at = entries_[at].below;
    return at;
  }

  std::vector<uint32_t> heads_; // by bucket; a power of two
  std::vector<Entry> entries_;
  std::vector<uint32_t> scopes_; // entries before each open region
};

} // namespace rung::ir
