// See part_stream.h.
#include "rtlib/record/part_stream.h"

namespace rung::runtime {

// What has come from outside since the last part, so that a player can compare the state.
void PartStream::keepBefore() noexcept {
  if (!whole_) return;
  if (!part_.fits()) return lose();
  if (part_.size() != 0) {
    putRepeats();
    batch_.putBytes(part_.written());
    part_.cut(0);
    last_.plain = false;
  }
  flush();
}

void PartStream::lose() noexcept {
  if (whole_) losses_.store(losses_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  lost_ = lost_ || whole_;
  whole_ = false;
  stateUs_ = kAtOnce;
  last_.plain = false;
  repeats_ = 0;
  part_.cut(0);
  batch_.cut(0);
}

void PartStream::keepPart() noexcept {
  putPart();
  if (!part_.fits()) return lose();
  putRepeats();
  last_ = {.kind = now_.kind, .plain = true, .number = now_.number};
  batch_.putBytes(part_.written());
  part_.cut(0);
  if (batch_.size() >= kBatch) flush();
}

void PartStream::putRepeats() noexcept {
  if (repeats_ != 0) batch_.put(Event::Repeat, repeats_);
  repeats_ = 0;
}

void PartStream::flush() noexcept {
  putRepeats();
  if (batch_.size() == 0) return;
  const bool kept = ring_.push(batch_.written());
  batch_.cut(0);
  if (!kept) lose();
}

} // namespace rung::runtime
