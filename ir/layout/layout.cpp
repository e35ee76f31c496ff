// The layout (see layout.h).
#include "ir/layout/layout.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

#include "ir/layout/representation.h"
#include "ir/support/check.h"
#include "ir/support/hash.h"

namespace rung::ir {
namespace {

constexpr uint32_t kBlockAlign = 64;

uint32_t alignUp(uint32_t value, uint32_t align) { return (value + align - 1) / align * align; }
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

// Fills a Layout step by step.
class LayoutBuilder {
public:
  LayoutBuilder(Layout& layout, const LayoutOptions& options)
      : layout_(layout), module_(*layout.module_), options_(options) {}

  void run() {
    placeSlots();
    placeSpaces();
    layout_.memorySize_ = alignUp(std::max(next_, 1u), kBlockAlign);
    numberRungs();
    markHeads();
    markParts();
    cutChunks();
    findPartEnds();
  }

private:
  // Widest first, so that each is aligned without gaps.
  void placeSlots() {
    layout_.slotOffsets_.resize(module_.slots.size());
    for (uint32_t size : {8u, 4u, 2u, 1u})
      for (size_t i = 0; i < module_.slots.size(); ++i)
        if (slotBytes(module_.slots[i]) == size) {
          layout_.slotOffsets_[i] = next_;
          next_ += size;
        }
  }

  void placeSpaces() {
    const Representation repr = chooseRepresentation(module_, options_.expandBits);
    for (const std::vector<uint8_t>& bytes : repr) {
      next_ = alignUp(next_, kBlockAlign);
      layout_.spaces_.emplace_back();
      for (uint32_t first = 0; first < bytes.size();) {
        uint32_t end = first;
        while (end < bytes.size() && bytes[end] == bytes[first]) ++end;
        placeRange(first, end - first, bytes[first]);
        first = end;
      }
    }
  }

  void placeRange(uint32_t first, uint32_t count, uint8_t repr) {
    // A packed range keeps the alignment that its bytes have in the space.
    if (repr == RUNG_REPR_PACKED) next_ = alignUp(next_, 8) + first % 8;
    layout_.spaces_.back().ranges.push_back({first, count, next_, repr});
    next_ += repr == RUNG_REPR_PACKED ? count : count * 8;
  }

  void numberRungs() {
    uint32_t number = 0;
    for (const Routine& routine : module_.routines) {
      layout_.firstRung_.push_back(number);
      number += static_cast<uint32_t>(routine.rungs.size());
    }
    layout_.rungCount_ = number;
  }

  void markHeads() {
    for (const Routine& routine : module_.routines) {
      std::vector<bool>& heads = heads_.emplace_back(routine.rungs.size(), false);
      heads[0] = true;
      for (size_t i = 0; i < routine.rungs.size(); ++i) {
        const Transfer& transfer = routine.rungs[i].transfer;
        if (transfer.kind == TransferKind::Next) continue;
        if (i + 1 < heads.size()) heads[i + 1] = true;
        if (transfer.kind == TransferKind::Goto) heads[transfer.target] = true;
        for (uint32_t target : transfer.targets) heads[target] = true;
      }
    }
  }

  // The rungs before which a part of a task ends.
  void markParts() {
    for (const Task& task : module_.tasks) {
      partBorders_.push_back(task.borders);
      for (const uint32_t rung : task.borders) heads_[task.entry.index][rung] = true;
    }
  }

  void cutChunks() {
    for (uint32_t r = 0; r < module_.routines.size(); ++r) {
      const std::vector<Rung>& rungs = module_.routines[r].rungs;
      std::vector<uint32_t>& chunkOf = layout_.chunkOfRung_.emplace_back();
      size_t ops = 0;
      for (uint32_t i = 0; i < rungs.size(); ++i) {
        const bool full = i > 0 && (layout_.chunks_.back().rungCount >= options_.maxChunkRungs ||
                                    ops + rungs[i].ops.size() > options_.maxChunkOps);
        if (heads_[r][i] || full) {
          layout_.chunks_.push_back({.routine = RoutineId{r}, .firstRung = i, .rungCount = 0, .weight = 0});
          ops = 0;
        }
        Chunk& chunk = layout_.chunks_.back();
        ++chunk.rungCount;
        chunk.weight += std::max(1u, rungs[i].weight);
        ops += rungs[i].ops.size();
        chunkOf.push_back(static_cast<uint32_t>(layout_.chunks_.size() - 1));
      }
    }
  }

  void findPartEnds() {
    for (size_t t = 0; t < module_.tasks.size(); ++t) {
      std::vector<uint32_t>& ends = layout_.partEnds_.emplace_back();
      for (uint32_t rung : partBorders_[t]) ends.push_back(layout_.chunkAt(module_.tasks[t].entry, rung));
    }
  }

  Layout& layout_;
  const Module& module_;
  const LayoutOptions& options_;
  uint32_t next_ = 0;
  std::vector<std::vector<bool>> heads_;
  std::vector<std::vector<uint32_t>> partBorders_;
};

Layout::Layout(const Module& module, const LayoutOptions& options) : module_(&module) {
  LayoutBuilder(*this, options).run();
}

BitLocation Layout::bit(SpaceId space, uint64_t bitOffset) const {
  const uint32_t byte = static_cast<uint32_t>(bitOffset / 8);
  const uint32_t bit = static_cast<uint32_t>(bitOffset % 8);
  const rung_range& range = rangeOf(spaces_[space.index], byte);
  if (range.repr == RUNG_REPR_BYTE_PER_BIT) return {range.offset + (byte - range.first_byte) * 8 + bit, 0, true};
  return {range.offset + (byte - range.first_byte), bit, false};
}

uint32_t Layout::byte(SpaceId space, uint32_t byteOffset) const {
  const rung_range& range = rangeOf(spaces_[space.index], byteOffset);
  RUNG_CHECK(range.repr == RUNG_REPR_PACKED, "byte access to an expanded byte");
  return range.offset + (byteOffset - range.first_byte);
}

uint32_t Layout::chunkAt(RoutineId routine, uint32_t rung) const {
  const uint32_t chunk = chunkOfRung_[routine.index][rung];
  RUNG_CHECK(chunks_[chunk].firstRung == rung, "control may enter a chunk at its head only");
  return chunk;
}

std::string Layout::text() const {
  std::string out;
  auto put = std::back_inserter(out);
  fmt::format_to(put, "memory {}\n", memorySize_);
  for (size_t i = 0; i < spaces_.size(); ++i) {
    const Space& space = module_->spaces[i];
    fmt::format_to(put, "space {} unit {} units {}\n", space.name, space.unitBytes, space.units);
    for (const rung_range& range : spaces_[i].ranges)
      fmt::format_to(put, "  bytes {} +{} at {} {}\n", range.first_byte, range.byte_count, range.offset,
                     range.repr == RUNG_REPR_PACKED ? "packed" : "byte-per-bit");
  }
  for (size_t i = 0; i < slotOffsets_.size(); ++i)
    fmt::format_to(put, "slot {} {} at {}\n", module_->slots[i].key, typeName(module_->slots[i].type), slotOffsets_[i]);
  return out;
}

uint64_t Layout::hash() const { return hashBytes(text()); }

Exit exitOf(const Layout& layout, uint32_t chunk) {
  const Chunk& place = layout.chunks()[chunk];
  const std::vector<Rung>& rungs = layout.module().at(place.routine).rungs;
  const uint32_t below = place.firstRung + place.rungCount;
  const Transfer& transfer = rungs[below - 1].transfer;
  Exit exit{.kind = transfer.kind,
            .cond = transfer.cond,
            .value = transfer.value,
            .taken = RUNG_NONE,
            .otherwise = RUNG_NONE,
            .targets = {}};
  if (below < rungs.size()) exit.otherwise = layout.chunkAt(place.routine, below);
  if (transfer.kind == TransferKind::Goto) exit.taken = layout.chunkAt(place.routine, transfer.target);
  if (transfer.kind == TransferKind::Call) exit.taken = layout.entry(transfer.callee);
  for (uint32_t target : transfer.targets) exit.targets.push_back(layout.chunkAt(place.routine, target));
  return exit;
}

} // namespace rung::ir
