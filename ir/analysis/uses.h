// What each rung of a module reads and writes, and what decides whether it runs: for explaining a program, not for
// engines. Made from the module as the front end built it, because passes drop reads that an engine does not need.
// Rungs are numbered over all routines, as in rung_program::rungs.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ir/core/memory_use.h"

namespace rung::ir {

// A use in a rung.
struct RungUse : Use {
  // For a computed place, the place with an index of 0, as far as the rung shows it: X for `X,REG`. Otherwise `place`.
  BitRange element;
  // For a read: its value is only used to write it back where a condition suppresses a write. A coil that sets a bit
  // reads it this way, and does not depend on its value.
  bool keeps = false;
  bool operator==(const RungUse&) const = default;
};

class Uses {
public:
  explicit Uses(const Module& module);

  uint32_t rungCount() const { return static_cast<uint32_t>(rungs_.size()); }
  // Each use once, in the order of the operations.
  std::span<const RungUse> of(uint32_t rung) const { return rungs_[rung].uses; }

  // Rungs that write a part of the place, ascending; separately, those that may write it at a computed address.
  struct Writers {
    std::vector<uint32_t> certain;
    std::vector<uint32_t> computed;
    bool none() const { return certain.empty() && computed.empty(); }
  };
  Writers writersOf(const BitRange& place) const;
  // The places from which the place is copied when a task begins or ends: input latches, images.
  std::vector<BitRange> copiedFrom(const BitRange& place) const;
  // The places to which it is copied then.
  std::vector<BitRange> copiedTo(const BitRange& place) const;
  // The place over which all of it is copied when a task begins or ends: for NC memory, the program's own.
  std::optional<BitRange> copiedWhole(const BitRange& place) const;
  // Whether a fault clears a part of the place: one that the control or the machine reads.
  bool isCleared(const BitRange& place) const;
  // Whether a part of it is retained through power-off.
  bool isRetained(const BitRange& place) const;

  // Rungs of the routine whose transfer decides whether this rung is skipped; the nearest first.
  std::vector<uint32_t> decidersOf(uint32_t rung) const;
  // Rungs that call the rung's routine, ascending.
  std::vector<uint32_t> callersOf(uint32_t rung) const;
  bool calls(uint32_t rung) const { return rungs_[rung].kind == TransferKind::Call; }

private:
  struct RungFacts {
    RoutineId routine;
    std::vector<RungUse> uses;
    TransferKind kind = TransferKind::Next;
    bool conditional = false;
    RoutineId callee;
    std::vector<uint32_t> targets; // Goto, Switch
  };
  static RungFacts factsOf(const Module& module, const Rung& rung);
  uint32_t firstOf(uint32_t rung) const { return firstRung_[rungs_[rung].routine.index]; }
  bool jumpsBetween(uint32_t rung, uint32_t above, uint32_t upTo) const;

  std::vector<RungFacts> rungs_;
  std::vector<uint32_t> firstRung_; // by routine
  std::vector<Copy> copies_;
  std::vector<SpaceSpan> cleared_;
  std::vector<SpaceSpan> retained_;
};

} // namespace rung::ir
