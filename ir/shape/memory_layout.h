// The place of every byte of a program's memory. Computed once from a program's shape and used by every engine and by
// the host; nothing else decides how a space is represented. The partition into chunks is independent of it
// (partition.h).
//
// Representation. A logical byte of a space is *expanded* (a byte per bit, see RUNG_REPR_BYTE_PER_BIT) if every access
// to it in the whole program is a fixed bit access, no non-bit symbol names it, it has no initial value, and the space
// is not packedOnly; otherwise it is packed. Bytes that a Copy connects have the same representation. Bytes without
// accesses are packed, except short gaps between expanded ones.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

// The place of a bit: bit `bit` of the byte at `offset`, or the whole byte (0 or 1) if `wholeByte`.
struct BitLocation {
  uint32_t offset = 0;
  uint32_t bit = 0;
  bool wholeByte = false;
};

inline constexpr uint32_t kBlockAlign = 64; // of the memory block, in bytes: rung_program::memory_align

struct SpaceLayout {
  std::vector<rung_range> ranges; // sorted, cover the space
};

class MemoryLayout {
public:
  // `module`, a shape (layout.h), has passed the verifier and must outlive the layout. `expandBits` false: everything
  // is packed.
  MemoryLayout(const Module& module, bool expandBits);

  const Module& module() const { return *module_; }
  uint32_t size() const { return size_; }

  BitLocation bit(SpaceId space, uint64_t bitOffset) const;
  // Offset of a byte in a packed range, which must contain `size` bytes from it.
  uint32_t byte(SpaceId space, uint32_t byteOffset) const;
  // The pieces of a span that are contiguous in the memory block.
  std::vector<rung_span> pieces(const SpaceSpan& span) const;
  uint32_t slot(SlotId slot) const { return slotOffsets_[slot.index]; }
  const SpaceLayout& space(SpaceId space) const { return spaces_[space.index]; }

  // The canonical text: equal texts mean interchangeable memory images. `layoutHash` is its hash.
  std::string text() const;
  uint64_t hash() const;

private:
  friend class MemoryPlacer;
  const Module* module_;
  uint32_t size_ = 0;
  std::vector<SpaceLayout> spaces_;
  std::vector<uint32_t> slotOffsets_;
};

} // namespace rung::ir
