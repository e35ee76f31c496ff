// A program that is to take over (see replacement.h).
#include "rtlib/host/replacement.h"

#include <algorithm>
#include <utility>

namespace rung::host {
namespace {

constexpr uint64_t kSwapCost = 3; // a byte that is swapped is copied there, here and back

} // namespace

Replacement::Replacement(const rung_program& running, const Runnable& next)
    : loaded_(next, running.memory_size), there_(running, next.program), back_(next.program, running) {
  if (next.memory == nullptr) planSharedBlock(running);
}

void Replacement::planSharedBlock(const rung_program& running) {
  const uint32_t bytes = std::max(running.memory_size, loaded_.program->memory_size);
  std::vector<bool> staying = there_.staying(bytes);
  const std::vector<bool> back = back_.staying(bytes);
  for (uint32_t i = 0; i < bytes; ++i) staying[i] = staying[i] && back[i];
  const auto changed = static_cast<uint64_t>(std::ranges::count(staying, false));
  if (kSwapCost * changed >= there_.bytes()) return;
  shared_ = {.there = there_.without(staying),
             .back = back_.without(staying),
             .swaps = StateTransfer::leaving(staying, 0, bytes),
             .swappedBytes = 2 * changed};
}

// The block may be another one than that in which the program once was, and may be the host's.
bool Replacement::mayShare(const LoadedProgram& running) const noexcept {
  return running.blockBytes >= loaded_.program->memory_size && loaded_.blockBytes >= running.program->memory_size &&
         reinterpret_cast<uintptr_t>(running.block.get()) % loaded_.program->memory_align == 0;
}

void Replacement::exchange(LoadedProgram& running) noexcept {
  const SharedBlock* shared = shared_ && mayShare(running) ? &*shared_ : nullptr;
  (shared != nullptr ? shared->there : there_).run(running.block.get(), loaded_.block.get());
  std::swap(running, loaded_);
  std::swap(there_, back_);
  if (shared_) std::swap(shared_->there, shared_->back);
  if (shared == nullptr) return;
  std::swap(running.block, loaded_.block);
  std::swap(running.blockBytes, loaded_.blockBytes);
  uint8_t* here = running.block.get();
  for (const rung_span& span : shared->swaps)
    std::swap_ranges(here + span.offset, here + span.offset + span.size, loaded_.block.get() + span.offset);
}

} // namespace rung::host
