// The layout (see layout.h).
#include "ir/layout/layout.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <numeric>
#include <span>

#include "ir/layout/representation.h"
#include "ir/support/check.h"
#include "ir/support/hash.h"
#include "ir/support/put.h"

namespace rung::ir {
namespace {

constexpr uint32_t kBlockAlign = 64;
constexpr uint32_t kRestingRungs = 32; // fewer: more to look at; more: they rest less often
// What a program decides takes a multiple of so many bytes: a changed program seldom needs more, and then what follows
// lies elsewhere and is copied.
constexpr uint32_t kRoom = 4096;

uint64_t alignUp(uint64_t value, uint32_t align) { return (value + align - 1) / align * align; }
uint32_t weightOf(const Rung& rung) { return std::max(1u, rung.weight); }
bool leavesRoutine(TransferKind kind) {
  return kind == TransferKind::Call || kind == TransferKind::Ret || kind == TransferKind::End;
}
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
      : layout_(layout), module_(*layout.module_), options_(options) {
    if (module_.activity) options_.maxChunkRungs = std::min(options_.maxChunkRungs, kRestingRungs);
  }

  void run() {
    placeSpaces();
    layout_.memorySize_ = used(alignUp(std::max<uint64_t>(next_, 1), kBlockAlign));
    numberRungs();
    for (uint32_t r = 0; r < module_.routines.size(); ++r) cutRoutine(r);
    findPartEnds();
  }

private:
  static uint32_t used(uint64_t offset) {
    RUNG_CHECK(offset <= UINT32_MAX, "the memory block has less than 4 GB");
    return static_cast<uint32_t>(offset);
  }

  // What is packed lies where it lies in its space, and what has the same size in every program of the dialect lies at
  // the same place, but for hidden spaces that follow what the program decides (its own spaces, expanded bits and
  // slots) after some room: so a program that takes over finds most of its state in place. Hidden ones come last, as
  // debuggers do not read a structure of any size.
  void placeSpaces() {
    for (const std::vector<uint8_t>& bytes : chooseRepresentation(module_, options_.expandBits)) {
      SpaceLayout& space = layout_.spaces_.emplace_back();
      for (uint32_t first = 0; first < bytes.size();) {
        uint32_t end = first;
        while (end < bytes.size() && bytes[end] == bytes[first]) ++end;
        space.ranges.push_back({first, end - first, 0, bytes[first]});
        first = end;
      }
    }
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

  // Widest first, so that each is aligned without gaps.
  void placeSlots() {
    layout_.slotOffsets_.resize(module_.slots.size());
    next_ = alignUp(next_, kBlockAlign);
    for (uint32_t size : {8u, 4u, 2u, 1u})
      for (size_t i = 0; i < module_.slots.size(); ++i)
        if (slotBytes(module_.slots[i]) == size) {
          layout_.slotOffsets_[i] = used(next_);
          next_ += size;
        }
  }

  void numberRungs() {
    uint32_t number = 0;
    for (const Routine& routine : module_.routines) {
      layout_.firstRung_.push_back(number);
      number += static_cast<uint32_t>(routine.rungs.size());
    }
    layout_.rungCount_ = number;
  }

  void cutRoutine(uint32_t routine) {
    const std::vector<Rung>& rungs = module_.routines[routine].rungs;
    markHeads(routine);
    measure(rungs);
    std::vector<uint32_t>& chunkOf = layout_.chunkOfRung_.emplace_back();
    layout_.behind_.emplace_back(rungs.size());
    const auto count = static_cast<uint32_t>(rungs.size());
    for (uint32_t first = 0; first < count;) {
      const uint32_t end = chunkEnd(first, count);
      chunkOf.insert(chunkOf.end(), end - first, static_cast<uint32_t>(layout_.chunks_.size()));
      layout_.chunks_.push_back({.routine = RoutineId{routine}, .firstRung = first, .rungCount = end - first});
      for (uint32_t i = first; i < end; ++i)
        forTargets(rungs[i].transfer, [&](uint32_t target) {
          if (target >= end) heads_[target] = true;
        });
      weigh(rungs, layout_.chunks_.back());
      first = end;
    }
  }

  // The rungs of a routine that begin a chunk wherever the others are cut.
  void markHeads(uint32_t routine) {
    const std::vector<Rung>& rungs = module_.routines[routine].rungs;
    heads_.assign(rungs.size() + 1, false);
    heads_[0] = true;
    for (const Task& task : module_.tasks) // the rungs before which a part ends
      if (task.entry.index == routine)
        for (const uint32_t rung : task.borders) heads_[rung] = true;
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      if (rungs[i].transfer.kind == TransferKind::Call) heads_[i + 1] = true;
      forTargets(rungs[i].transfer, [&](uint32_t target) {
        if (target <= i) heads_[target] = true;
      });
    }
  }

  void weigh(const std::vector<Rung>& rungs, Chunk& chunk) {
    const uint32_t end = chunk.firstRung + chunk.rungCount;
    std::vector<uint32_t>& behind = layout_.behind_[chunk.routine.index];
    for (uint32_t i = end; i-- > chunk.firstRung;) {
      const Transfer& transfer = rungs[i].transfer;
      uint32_t least = UINT32_MAX;
      const auto way = [&](uint32_t to) {
        least = to <= i || to >= end ? 0 : std::min(least, weightOf(rungs[to]) + behind[to]);
      };
      if (transfer.kind == TransferKind::Next || transfer.cond.valid()) way(i + 1);
      forTargets(transfer, way);
      behind[i] = least == UINT32_MAX ? 0 : least; // nowhere in the routine: back to the caller, or the run's end
      if (leavesRoutine(transfer.kind)) behind[i] = 0;
    }
    chunk.weight = weightOf(rungs[chunk.firstRung]) + behind[chunk.firstRung];
  }

  // For chunkEnd: operations in front of each rung, and jumps that lead over the border in front of it.
  void measure(const std::vector<Rung>& rungs) {
    opsBefore_.assign(1, 0);
    crossing_.assign(rungs.size() + 2, 0);
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      opsBefore_.push_back(opsBefore_.back() + rungs[i].ops.size());
      forTargets(rungs[i].transfer, [&](uint32_t target) {
        if (target <= i + 1) return;
        ++crossing_[i + 1];
        --crossing_[target];
      });
    }
    std::partial_sum(crossing_.begin(), crossing_.end(), crossing_.begin());
  }

  // A full chunk is cut in its second half, as late as possible where the fewest jumps would have to leave it.
  uint32_t chunkEnd(uint32_t first, uint32_t count) const {
    uint32_t end = first + 1;
    while (end < count && !heads_[end] && end - first < options_.maxChunkRungs &&
           opsBefore_[end + 1] - opsBefore_[first] <= options_.maxChunkOps)
      ++end;
    if (end == count || heads_[end]) return end;
    uint32_t best = end;
    for (uint32_t i = end; i > first + (end - first) / 2; --i)
      if (crossing_[i] < crossing_[best]) best = i;
    return best;
  }

  template <class Visit>
  static void forTargets(const Transfer& transfer, Visit visit) {
    if (transfer.kind == TransferKind::Goto) visit(transfer.target);
    for (uint32_t target : transfer.targets) visit(target);
  }

  void findPartEnds() {
    for (size_t t = 0; t < module_.tasks.size(); ++t) {
      std::vector<uint32_t>& ends = layout_.partEnds_.emplace_back();
      for (uint32_t rung : module_.tasks[t].borders) ends.push_back(layout_.chunkAt(module_.tasks[t].entry, rung));
    }
  }

  Layout& layout_;
  const Module& module_;
  LayoutOptions options_;
  uint64_t next_ = 0; // free place of the memory block
  // Of the routine in hand, by rung.
  std::vector<bool> heads_;
  std::vector<int32_t> crossing_;
  std::vector<size_t> opsBefore_;
};

Layout::Layout(const Module& module, const LayoutOptions& options) : module_(&module) {
  LayoutBuilder(*this, options).run();
}

Layout Layout::over(const Module& module) const {
  Layout other = *this;
  other.module_ = &module;
  return other;
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

std::vector<rung_span> Layout::pieces(const SpaceSpan& span) const {
  std::vector<rung_span> out;
  uint32_t done = 0;
  for (const rung_range& range : space(span.space).ranges) {
    const uint32_t first = std::max(range.first_byte, span.byte);
    const uint32_t end = std::min(range.first_byte + range.byte_count, span.byte + span.size);
    if (first >= end) continue;
    const uint32_t scale = range.repr == RUNG_REPR_PACKED ? 1 : 8;
    out.push_back({range.offset + (first - range.first_byte) * scale, (end - first) * scale});
    done += end - first;
  }
  RUNG_CHECK(done == span.size, "span outside its space");
  return out;
}

uint32_t Layout::chunkAt(RoutineId routine, uint32_t rung) const {
  const uint32_t chunk = chunkOfRung_[routine.index][rung];
  RUNG_CHECK(chunks_[chunk].firstRung == rung, "control may enter a chunk at its head only");
  return chunk;
}

std::string Layout::text() const {
  std::string out;
  put(out, "memory {}\n", memorySize_);
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

uint64_t Layout::hash() const { return hashBytes(text()); }

Destination Layout::destination(RoutineId routine, uint32_t from, uint32_t to) const {
  const std::vector<uint32_t>& chunkOf = chunkOfRung_[routine.index];
  if (to <= from || chunkOf[to] != chunkOf[from]) return {.chunk = chunkAt(routine, to)};
  const std::vector<uint32_t>& behind = behind_[routine.index];
  return {
      .chunk = chunkOf[to], .rung = to, .extra = weightOf(module_->at(routine).rungs[to]) + behind[to] - behind[from]};
}

Exit exitOf(const Layout& layout, RoutineId routine, uint32_t rung) {
  const std::vector<Rung>& rungs = layout.module().at(routine).rungs;
  const Transfer& transfer = rungs[rung].transfer;
  Exit exit{.kind = transfer.kind,
            .cond = transfer.cond,
            .value = transfer.value,
            .taken = {},
            .otherwise = {},
            .targets = {}};
  const bool goesOn =
      transfer.kind == TransferKind::Next || transfer.kind == TransferKind::Call || transfer.cond.valid();
  if (goesOn && rung + 1 < rungs.size()) exit.otherwise = layout.destination(routine, rung, rung + 1);
  if (transfer.kind == TransferKind::Goto) exit.taken = layout.destination(routine, rung, transfer.target);
  if (transfer.kind == TransferKind::Call) exit.taken = {.chunk = layout.entry(transfer.callee)};
  for (uint32_t target : transfer.targets) exit.targets.push_back(layout.destination(routine, rung, target));
  return exit;
}

std::vector<Exit> exitsOf(const Layout& layout, const Chunk& chunk) {
  std::vector<Exit> exits;
  for (uint32_t i = 0; i < chunk.rungCount; ++i) exits.push_back(exitOf(layout, chunk.routine, chunk.firstRung + i));
  return exits;
}

bool hostReadsMemory(const Layout& layout, const Chunk& chunk) {
  const std::span rungs(layout.module().at(chunk.routine).rungs);
  return std::ranges::any_of(rungs.subspan(chunk.firstRung, chunk.rungCount), [](const Rung& rung) {
    return std::ranges::any_of(rung.ops, [](const Op& op) { return hostReads(opInfo(op.code)); });
  });
}

bool hasExtraWeight(const std::vector<Exit>& exits) {
  return std::any_of(exits.begin(), exits.end(), [](const Exit& exit) {
    return exit.taken.extra != 0 || exit.otherwise.extra != 0 ||
           std::any_of(exit.targets.begin(), exit.targets.end(), [](const Destination& to) { return to.extra != 0; });
  });
}

} // namespace rung::ir
