// The partition of control into chunks, which engines compile and the runner enters. Decided once from a program's
// shape (layout.h), independently of the memory layout (memory_layout.h).
//
// A chunk is a run of at most `maxChunkRungs` rungs (and about `maxChunkOps` operations) of one routine, entered only
// at its first rung. Within it control only goes down: a Goto or Switch to a rung further down in the same chunk stays
// inside, every other one leaves the chunk. So a chunk begins at each routine's start, after every Call, where a part
// of a task begins, and at every target that is not below its jump in the same chunk. Compile time grows linearly with
// the number of chunks.
//
// The watchdog counts the rungs that run: a chunk has the weight of the lightest path from its first rung out of it,
// and a jump or a step down within it that is not on the lightest path from there costs the difference
// (Destination::extra). So counting a jump over rungs that are mostly idle costs nothing.
#pragma once
#include <cstdint>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

struct PartitionOptions {
  uint32_t maxChunkRungs = 256; // fewer: the host's dispatch of chunks becomes noticeable; more: compilers slow down
  uint32_t maxChunkOps = 1024;
};

struct Chunk {
  RoutineId routine;
  uint32_t firstRung = 0; // index in the routine
  uint32_t rungCount = 0;
  uint32_t weight = 1; // of the lightest path through it
};

// Where control goes after a rung: further down in its chunk, or to a chunk, whose number the compiled chunk returns.
struct Destination {
  uint32_t chunk = RUNG_NONE; // RUNG_NONE: back to the caller
  uint32_t rung = RUNG_NONE;  // index in the routine, if in the same chunk
  uint32_t extra = 0;         // weight in addition to the chunk's; 0 at an exit of the chunk
  bool inside() const { return rung != RUNG_NONE; }
};

class Partition {
public:
  // `module`, a shape, has passed the verifier and must outlive the partition.
  Partition(const Module& module, const PartitionOptions& options);

  // The same chunks for a variant of the module, whose rungs must have the same exits, or fewer: that is checked.
  Partition over(const Module& module) const;

  const Module& module() const { return *module_; }
  const std::vector<Chunk>& chunks() const { return chunks_; }
  // The chunk that begins with this rung; defined for every rung that control can reach from another chunk.
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
  // For each part of a task but the last, the chunk before which it ends.
  const std::vector<uint32_t>& partEnds(TaskId task) const { return partEnds_[task.index]; }

private:
  friend class Partitioner;
  const Module* module_;
  std::vector<Chunk> chunks_;
  std::vector<std::vector<uint32_t>> chunkOfRung_; // by routine and rung: the chunk that contains it
  std::vector<std::vector<uint32_t>> after_; // by routine and rung: the lightest path after it to the end of the chunk
  std::vector<uint32_t> firstRung_;
  uint32_t rungCount_ = 0;
  std::vector<std::vector<uint32_t>> partEnds_;
};

// How control leaves a rung, with all destinations that engines need.
struct Exit {
  TransferKind kind = TransferKind::Next;
  ValueId cond;                     // invalid: always
  ValueId value;                    // Switch: the value
  Destination taken;                // Goto: its target; Call: the entry of the callee
  Destination otherwise;            // where control goes if cond is 0, and where a Call returns
  std::vector<Destination> targets; // Switch
};
Exit exitOf(const Partition& partition, RoutineId routine, uint32_t rung);

} // namespace rung::ir
