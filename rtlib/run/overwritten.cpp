// Which places are overwritten, from the tables of the program (see overwritten.h).
#include "rtlib/run/overwritten.h"

#include <algorithm>
#include <span>

#include "rtlib/load/program_info.h"

namespace rung::runtime {
namespace {

bool covers(const rung_copy& outer, const rung_copy& inner) {
  return outer.kind == RUNG_COPY_ALL && outer.to <= inner.to && outer.to + outer.size >= inner.to + inner.size;
}

uint32_t byteCount(const Ref& ref) {
  switch (ref.kind) {
  case RefKind::Text: return ref.count;
  case RefKind::Constant: return 0;
  case RefKind::Bit: return 1;
  case RefKind::Int:
  case RefKind::Real: break;
  }
  return std::max(1u, ref.width / 8u);
}

} // namespace

// The input copy that ends in the byte of the memory block; null: none does. A place that the task gives back at its
// end (registers that an interrupting task saves) is not overwritten.
const rung_copy* Overwritten::over(uint32_t offset) const {
  for (const rung_task& task : std::span(program_->tasks, program_->task_count)) {
    const std::span end(program_->copies + task.end_first, task.end_count);
    for (const rung_copy& copy : std::span(program_->copies + task.begin_first, task.begin_count))
      if (copy.kind == RUNG_COPY_ALL && offset >= copy.to && offset - copy.to < copy.size &&
          std::ranges::none_of(end, [&](const rung_copy& other) { return covers(other, copy); }))
        return &copy;
  }
  return nullptr;
}

std::optional<Ref> Overwritten::source(const Ref& ref) const {
  if (program_->copy_count == 0) return std::nullopt;
  const core::Memory memory(*program_, nullptr); // for its places only
  for (uint32_t i = 0; i < byteCount(ref); ++i) {
    const core::Place place = memory.locateBit(ref.space, ref.byte + i, 0);
    if (place.outside()) continue;
    const rung_copy* copy = over(place.offset());
    if (copy == nullptr) continue;
    const auto from = byteAt(*program_, copy->from + (place.offset() - copy->to));
    if (!from || from->byte < i) continue;
    Ref source = ref;
    source.space = from->space;
    source.byte = from->byte - i;
    return source;
  }
  return std::nullopt;
}

} // namespace rung::runtime
