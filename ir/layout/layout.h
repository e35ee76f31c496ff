// Layout: where every byte of a program's memory lies and how its rungs are cut into chunks. Computed once from a
// final module and obeyed by every engine and by the host; nothing else decides how a space is represented.
//
// Representation. A logical byte of a space is *expanded* (a byte a bit, see RUNG_REPR_BYTE_PER_BIT) when every access
// to it in the whole program is a fixed bit access, no non-bit symbol names it, it has no initial value, and the space
// is not packedOnly; it is packed otherwise. Bytes that a Copy connects have one representation. Bytes that nothing
// touches are packed, but for short gaps between expanded ones.
//
// Chunks. A chunk is a run of at most `maxChunkRungs` rungs (and about `maxChunkOps` operations) of one routine,
// entered only at its head. Within it control goes down only: a Goto or Switch to a rung further down in the same chunk
// stays inside, every other one leaves. So a chunk begins at each routine's start, behind every Call, where a part of a
// task begins, and at every target that is not below its jump in one chunk. Compile time grows linearly with the number
// of chunks.
//
// The watchdog counts the rungs that are run: a chunk weighs what its lightest way from the head out weighs, and a jump
// or a step down within it that is not on the lightest way from there costs the difference (Destination::extra). So a
// jump over something that mostly rests costs nothing to count.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

struct LayoutOptions {
  uint32_t maxChunkRungs = 256; // fewer: the host's jump from chunk to chunk shows; more: compilers slow down
  uint32_t maxChunkOps = 1024;
  bool expandBits = true; // false: everything is packed
};

// Where a bit lies: bit `bit` of the byte at `offset`, or the whole byte (0 or 1) when `wholeByte`.
struct BitLocation {
  uint32_t offset = 0;
  uint32_t bit = 0;
  bool wholeByte = false;
};

struct Chunk {
  RoutineId routine;
  uint32_t firstRung = 0; // in the routine
  uint32_t rungCount = 0;
  uint32_t weight = 1; // of the lightest way through it
};

struct SpaceLayout {
  std::vector<rung_range> ranges; // sorted, cover the space
};

struct Destination;

class Layout {
public:
  // `module` has passed the verifier in mode Final and outlives the layout.
  Layout(const Module& module, const LayoutOptions& options);

  // The same memory and the same chunks for another form of the module, whose rungs have the same ways out, or fewer.
  Layout over(const Module& module) const;

  const Module& module() const { return *module_; }
  uint32_t memorySize() const { return memorySize_; }

  BitLocation bit(SpaceId space, uint64_t bitOffset) const;
  // Offset of a byte that lies in a packed range; `size` bytes from it lie there too.
  uint32_t byte(SpaceId space, uint32_t byteOffset) const;
  // The pieces of a span that lie together in the memory block.
  std::vector<rung_span> pieces(const SpaceSpan& span) const;
  uint32_t slot(SlotId slot) const { return slotOffsets_[slot.index]; }
  const SpaceLayout& space(SpaceId space) const { return spaces_[space.index]; }

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

  // The canonical text: equal texts mean interchangeable memory images. `layoutHash` is its hash.
  std::string text() const;
  uint64_t hash() const;

private:
  friend class LayoutBuilder;
  const Module* module_;
  uint32_t memorySize_ = 0;
  std::vector<SpaceLayout> spaces_;
  std::vector<uint32_t> slotOffsets_;
  std::vector<Chunk> chunks_;
  std::vector<std::vector<uint32_t>> chunkOfRung_; // per routine and rung: the chunk it is in
  std::vector<std::vector<uint32_t>> behind_; // per routine and rung: the lightest way behind it to the chunk's end
  std::vector<uint32_t> firstRung_;
  uint32_t rungCount_ = 0;
  std::vector<std::vector<uint32_t>> partEnds_;
};

// Where control goes behind a rung: further down in its chunk, or to a chunk, whose number the compiled chunk returns.
struct Destination {
  uint32_t chunk = RUNG_NONE; // RUNG_NONE: back to the caller
  uint32_t rung = RUNG_NONE;  // of the routine, when it lies in the same chunk
  uint32_t extra = 0;         // weight on top of the chunk's; 0 where the chunk is left
  bool inside() const { return rung != RUNG_NONE; }
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
Exit exitOf(const Layout& layout, RoutineId routine, uint32_t rung);
// The exits of a chunk's rungs.
std::vector<Exit> exitsOf(const Layout& layout, const Chunk& chunk);
// Whether the host may read memory while the chunk runs. Elsewhere nobody but the chunk reaches the memory block, and
// back ends say so to their compilers.
bool hostReadsMemory(const Layout& layout, const Chunk& chunk);
// Whether some way through the chunk costs extra weight.
bool hasExtraWeight(const std::vector<Exit>& exits);

} // namespace rung::ir
