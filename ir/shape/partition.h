// How control is cut into chunks, the pieces that engines compile and the runner enters. Decided once from a
// program's shape (layout.h); where a byte lies is another matter (memory_layout.h).
//
// A chunk is a run of at most `maxChunkRungs` rungs (and about `maxChunkOps` operations) of one routine, entered only
// at its head. Within it control goes down only: a Goto or Switch to a rung further down in the same chunk stays
// inside, every other one leaves. So a chunk begins at each routine's start, after every Call, where a part of a task
// begins, and at every target that is not below its jump in one chunk. Compile time grows linearly with the number of
// chunks.
//
// The watchdog counts the rungs that are run: a chunk weighs what its lightest way from the head out weighs, and a jump
// or a step down within it that is not on the lightest way from there costs the difference (Destination::extra). So a
// jump over something that is mostly idle costs nothing to count.
#pragma once
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

struct PartitionOptions {
  uint32_t maxChunkRungs = 256; // fewer: the host's jump from chunk to chunk shows; more: compilers slow down
  uint32_t maxChunkOps = 1024;
};

struct Chunk {
  RoutineId routine;
  uint32_t firstRung = 0; // in the routine
  uint32_t rungCount = 0;
  uint32_t weight = 1; // of the lightest way through it
};

// Where control goes after a rung: further down in its chunk, or to a chunk, whose number the compiled chunk returns.
struct Destination {
  uint32_t chunk = RUNG_NONE; // RUNG_NONE: back to the caller
  uint32_t rung = RUNG_NONE;  // of the routine, when it lies in the same chunk
  uint32_t extra = 0;         // weight on top of the chunk's; 0 where the chunk is left
  bool inside() const { return rung != RUNG_NONE; }
};

class Partition {
public:
  // `module`, a shape, has passed the verifier and outlives the cut.
  Partition(const Module& module, const PartitionOptions& options);

  // The same chunks of another form of the module, whose rungs have the same exits, or fewer: that is checked.
  Partition over(const Module& module) const;

  const Module& module() const { return *module_; }
  const std::vector<Chunk>& chunks() const { return chunks_; }
  // The chunk that begins with this rung; it exists for every place that control can reach from elsewhere.
  uint32_t chunkAt(RoutineId routine, uint32_t rung) const;
  uint32_t entry(RoutineId routine) const { return chunkAt(routine, 0); }
  // From one rung of a routine to another.
  Destination destination(RoutineId routine, uint32_t from, uint32_t to) const;
  // Number of a rung over all routines, as rung_program counts them.
  uint32_t rungNumber(RoutineId routine, uint32_t rung) const {
    const Rung& at = module_->at(routine).rungs[rung];
    return at.origin.index == RUNG_NONE ? firstRung_[routine.index] + rung : at.origin.index;
  }
  uint32_t rungCount() const { return rungCount_; }
  // Chunks before which parts of a task end; one entry fewer than its parts.
  const std::vector<uint32_t>& partEnds(TaskId task) const { return partEnds_[task.index]; }

private:
  friend class Partitioner;
  const Module* module_;
  std::vector<Chunk> chunks_;
  std::vector<std::vector<uint32_t>> chunkOfRung_; // per routine and rung: the chunk it is in
  std::vector<std::vector<uint32_t>> after_;       // per routine and rung: the lightest way after it to the chunk's end
  std::vector<uint32_t> firstRung_;
  uint32_t rungCount_ = 0;
  std::vector<std::vector<uint32_t>> partEnds_;
};

// How a rung is left. These places are all that engines need; they decide nothing themselves.
struct Exit {
  TransferKind kind = TransferKind::Next;
  ValueId cond;                     // invalid: always
  ValueId value;                    // Switch
  Destination taken;                // Goto: its target; Call: the entry of the callee
  Destination otherwise;            // where it goes when cond is 0, and where a Call comes back to
  std::vector<Destination> targets; // Switch
};
Exit exitOf(const Partition& partition, RoutineId routine, uint32_t rung);

} // namespace rung::ir
