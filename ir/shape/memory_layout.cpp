// Places cells and slots in the memory block (see memory_layout.h).
#include "ir/shape/memory_layout.h"

#include <algorithm>
#include <iterator>

#include "ir/shape/representation.h"
#include "ir/support/check.h"
#include "ir/support/hash.h"
#include "ir/support/put.h"
#include "rung/types.hpp"

namespace rung::ir {
namespace {

// Areas whose size depends on the program are rounded up to a multiple of this number of bytes: a changed program
// seldom needs more; if it does, the areas after it move and must be copied.
constexpr uint32_t kRoom = 4096;

uint64_t alignUp(uint64_t value, uint32_t align) { return (value + align - 1) / align * align; }
uint32_t slotBytes(const Slot& slot) { return std::max(1u, byteWidth(slot.type)); }

const rung_range& rangeOf(const SpaceLayout& space, uint32_t byte) {
  auto after = std::upper_bound(space.ranges.begin(), space.ranges.end(), byte,
                                [](uint32_t b, const rung_range& range) { return b < range.first_byte; });
  RUNG_CHECK(after != space.ranges.begin(), "byte outside its space");
  const rung_range& range = *std::prev(after);
  RUNG_CHECK(byte - range.first_byte < range.byte_count, "byte outside its space");
  return range;
}

} // namespace

// Fills a MemoryLayout step by step.
class MemoryPlacer {
public:
  explicit MemoryPlacer(MemoryLayout& layout) : layout_(layout), module_(*layout.module_) {}

  void run(bool expandBits) {
    findRanges(expandBits);
    placeSpaces();
    layout_.size_ = used(alignUp(std::max<uint64_t>(next_, 1), kBlockAlign));
  }

private:
  static uint32_t used(uint64_t offset) {
    RUNG_CHECK(offset <= UINT32_MAX, "the memory block has less than 4 GB");
    return static_cast<uint32_t>(offset);
  }

  void findRanges(bool expandBits) {
    for (const std::vector<uint8_t>& bytes : chooseRepresentation(module_, expandBits)) {
      SpaceLayout& space = layout_.spaces_.emplace_back();
      for (uint32_t first = 0; first < bytes.size();) {
        uint32_t end = first;
        while (end < bytes.size() && bytes[end] == bytes[first]) ++end;
        space.ranges.push_back({first, end - first, 0, bytes[first]});
        first = end;
      }
    }
  }

  // Packed spaces keep their byte order, and spaces with the same size in every program of the dialect have the same
  // place, so that a replacement finds most of its state in place. Only hidden spaces follow, after some reserve, the
  // areas whose size depends on the program (its own spaces, expanded bits and slots): they are last because debuggers
  // do not read structures of any size.
  void placeSpaces() {
    placePacked(0);
    const uint64_t decided = next_;
    placePacked(RUNG_SPACE_ALLOCATED);
    placeExpanded();
    placeSlots();
    next_ = decided + alignUp(next_ - decided, kRoom);
    placePacked(RUNG_SPACE_HIDDEN);
    placePacked(RUNG_SPACE_HIDDEN | RUNG_SPACE_ALLOCATED);
  }

  void placePacked(uint32_t flags) {
    for (size_t s = 0; s < module_.spaces.size(); ++s)
      if ((module_.spaces[s].flags & (RUNG_SPACE_HIDDEN | RUNG_SPACE_ALLOCATED)) == flags)
        placePacked(layout_.spaces_[s]);
  }

  void placePacked(SpaceLayout& space) {
    next_ = alignUp(next_, kBlockAlign);
    for (rung_range& range : space.ranges)
      if (range.repr == RUNG_REPR_PACKED) range.offset = used(next_ + range.first_byte);
    if (!space.ranges.empty()) next_ += space.ranges.back().first_byte + space.ranges.back().byte_count;
  }

  void placeExpanded() {
    next_ = alignUp(next_, kBlockAlign);
    for (SpaceLayout& space : layout_.spaces_)
      for (rung_range& range : space.ranges) {
        if (range.repr == RUNG_REPR_PACKED) continue;
        range.offset = used(next_);
        next_ += uint64_t{range.byte_count} * 8;
      }
  }

  // Widest first, so that each is aligned without gaps; one more slot of a size seldom moves those of other sizes.
  void placeSlots() {
    layout_.slotOffsets_.resize(module_.slots.size());
    for (uint32_t size : {8u, 4u, 2u, 1u}) {
      next_ = alignUp(next_, kBlockAlign);
      for (size_t i = 0; i < module_.slots.size(); ++i)
        if (slotBytes(module_.slots[i]) == size) {
          layout_.slotOffsets_[i] = used(next_);
          next_ += size;
        }
    }
  }

  MemoryLayout& layout_;
  const Module& module_;
  uint64_t next_ = 0; // next free offset in the memory block
};

MemoryLayout::MemoryLayout(const Module& module, bool expandBits) : module_(&module) {
  MemoryPlacer(*this).run(expandBits);
}

BitLocation MemoryLayout::bit(SpaceId space, uint64_t bitOffset) const {
  const uint32_t byte = static_cast<uint32_t>(bitOffset / 8);
  const uint32_t bit = static_cast<uint32_t>(bitOffset % 8);
  const rung_range& range = rangeOf(spaces_[space.index], byte);
  if (range.repr == RUNG_REPR_BYTE_PER_BIT) return {range.offset + (byte - range.first_byte) * 8 + bit, 0, true};
  return {range.offset + (byte - range.first_byte), bit, false};
}

uint32_t MemoryLayout::byte(SpaceId space, uint32_t byteOffset) const {
  const rung_range& range = rangeOf(spaces_[space.index], byteOffset);
  RUNG_CHECK(range.repr == RUNG_REPR_PACKED, "byte access to an expanded byte");
  return range.offset + (byteOffset - range.first_byte);
}

std::vector<rung_span> MemoryLayout::pieces(const SpaceSpan& span) const {
  std::vector<rung_span> out;
  uint32_t done = 0;
  for (const rung_range& range : space(span.space).ranges) {
    const uint32_t first = std::max(range.first_byte, span.byte);
    const uint32_t end = std::min(range.first_byte + range.byte_count, span.byte + span.size);
    if (first >= end) continue;
    const uint32_t scale = bytesPerByte(range.repr);
    out.push_back({range.offset + (first - range.first_byte) * scale, (end - first) * scale});
    done += end - first;
  }
  RUNG_CHECK(done == span.size, "span outside its space");
  return out;
}

std::string MemoryLayout::text() const {
  std::string out;
  put(out, "memory {}\n", size_);
  for (size_t i = 0; i < spaces_.size(); ++i) {
    const Space& space = module_->spaces[i];
    put(out, "space {} unit {} units {}\n", space.name, space.unitBytes, space.units);
    for (const rung_range& range : spaces_[i].ranges)
      put(out, "  bytes {} +{} at {} {}\n", range.first_byte, range.byte_count, range.offset,
          range.repr == RUNG_REPR_PACKED ? "packed" : "byte-per-bit");
  }
  for (size_t i = 0; i < slotOffsets_.size(); ++i)
    put(out, "slot {} {} at {}\n", module_->slots[i].key, typeName(module_->slots[i].type), slotOffsets_[i]);
  return out;
}

uint64_t MemoryLayout::hash() const { return hashBytes(text()); }

} // namespace rung::ir
