// A program that is to take over (see replacement.h).
#include "rtlib/change/replacement.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace rung::runtime {
namespace {

constexpr uint64_t kSwapCost = 3; // copies per swapped byte

// The initial contents of a program's block at these places, concatenated.
std::vector<uint8_t> initialContents(const rung_program& program, std::span<const rung_span> places, uint32_t bytes) {
  std::vector<uint8_t> block(bytes), contents;
  for (uint32_t i = 0; i < program.init_count; ++i)
    std::memcpy(block.data() + program.inits[i].offset, program.inits[i].data, program.inits[i].size);
  for (const rung_span& place : places)
    contents.insert(contents.end(), block.begin() + place.offset, block.begin() + place.offset + place.size);
  return contents;
}

} // namespace

Replacement::Replacement(const rung_program& running, const Runnable& next, const Naming& naming)
    : loaded_(next, running.memory_size),
      directions_{Direction(running, next.program, naming), Direction(next.program, running, naming)} {
  if (next.memory == nullptr) planSharedBlock(running);
}

void Replacement::planSharedBlock(const rung_program& running) {
  const uint32_t bytes = std::max(running.memory_size, loaded_.program->memory_size);
  std::vector<bool> staying = directions_[0].transfer.staying(bytes);
  const std::vector<bool> back = directions_[1].transfer.staying(bytes);
  for (uint32_t i = 0; i < bytes; ++i) staying[i] = staying[i] && back[i];
  const auto changed = static_cast<uint64_t>(std::ranges::count(staying, false));
  if (kSwapCost * changed >= directions_[0].transfer.bytes()) return;
  sharesBlock_ = true;
  swappedBytes_ = changed;
  swaps_ = StateTransfer::leaving(staying, 0, bytes);
  for (Direction& direction : directions_) direction.inSharedBlock = direction.transfer.without(staying);
  directions_[0].contents = initialContents(*loaded_.program, swaps_, bytes);
  directions_[1].contents = initialContents(running, swaps_, bytes);
}

// The block may differ from the one that the program used before, and may belong to the host.
bool Replacement::mayShare(const LoadedProgram& running) const noexcept {
  return sharesBlock_ && running.blockBytes >= loaded_.program->memory_size &&
         loaded_.blockBytes >= running.program->memory_size &&
         reinterpret_cast<uintptr_t>(running.block.get()) % loaded_.program->memory_align == 0;
}

void Replacement::beginAnew(bool shares) noexcept {
  if (!shares) return loaded_.clear();
  const uint8_t* contents = direction().contents.data();
  for (const rung_span& span : swaps_) {
    std::memcpy(loaded_.block.get() + span.offset, contents, span.size);
    contents += span.size;
  }
}

void Replacement::exchange(LoadedProgram& running, OwnContents own) noexcept {
  const bool shares = mayShare(running);
  if (own == OwnContents::Initial && hasRun_) beginAnew(shares);
  (shares ? direction().inSharedBlock : direction().transfer).run(running.block.get(), loaded_.block.get());
  std::swap(running, loaded_);
  hasRun_ = true;
  isReturn_.store(!isReturn_.load(std::memory_order_relaxed), std::memory_order_release);
  if (!shares) return;
  std::swap(running.block, loaded_.block);
  std::swap(running.blockBytes, loaded_.blockBytes);
  uint8_t* here = running.block.get();
  for (const rung_span& span : swaps_)
    std::swap_ranges(here + span.offset, here + span.offset + span.size, loaded_.block.get() + span.offset);
}

} // namespace rung::runtime
