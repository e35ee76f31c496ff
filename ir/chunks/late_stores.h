// Stores that a chunk may do once, when it is left, instead of in many places: each instruction of arithmetic writes
// the flags of its result over those of the one before, and hardly anybody reads them. What a place remembers is the
// one number that its flags follow from; the last one remembered is what counts.
//
// The memory block is the same wherever the chunk is left. So nothing in the chunk may access such a cell but these
// stores, and no chunk has them that the host may look into, or that may end with a fault. There are more places than
// ways out of the chunk, for each of these does them.
#pragma once
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "ir/chunks/cut.h"

namespace rung::ir {

class LateStores {
public:
  // Stores side by side whose values follow from one value, in all places of the chunk in the same way.
  struct Group {
    const Rung* rung; // of the first place: its operations do it for all
    ValueId from;
    int64_t never;              // a number that the value never is
    std::vector<const Op*> ops; // what computes the values, and the stores, as they are in the rung
  };
  // What a store is for the chunk.
  enum class Role : uint8_t {
    Ordinary,
    Remembers, // a number is remembered in its place
    Forgets,   // it is done, and what was remembered counts no more
  };
  struct Part {
    Role role = Role::Ordinary;
    bool isFirst = false; // the one of its place that remembers or forgets for all of them
    uint32_t group = 0;
    ValueId from; // to be remembered
  };

  LateStores() = default; // none
  // `exits`: of the chunk's rungs (exitsOf).
  LateStores(const Module& module, const Chunk& chunk, std::span<const Exit> exits);

  std::span<const Group> groups() const { return groups_; }
  Part of(const Op& store) const {
    const auto found = parts_.find(&store);
    return found == parts_.end() ? Part{} : found->second;
  }

private:
  friend class LateStoreFinder;
  std::vector<Group> groups_;
  std::unordered_map<const Op*, Part> parts_; // of stores that are not ordinary
};

} // namespace rung::ir
