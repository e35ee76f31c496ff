// What of each copy is needed (see copy_lists.h).
#include "rtlib/host/copy_lists.h"

#include <algorithm>

namespace rung::host {
namespace {

constexpr uint32_t kLeast = 256; // bytes: shorter copies stay whole
// Bytes that are needed or not together, in lines of the runner's loops; bytes in between that take no longer to copy
// than another copy takes to begin.
constexpr uint32_t kPiece = 16, kGap = 64;
constexpr uint32_t kMaskedPiece = 64, kMaskedGap = 64;

struct Part { // of a copy
  uint32_t first = 0;
  uint32_t end = 0;
};

// The parts with bytes for which `needed`, in pieces.
std::vector<Part> partsOf(const rung_copy& copy, const std::vector<bool>& needed, uint32_t at, uint32_t piece,
                          uint32_t gap) {
  std::vector<Part> parts;
  const auto begin = needed.begin() + at;
  for (uint32_t first = 0; first < copy.size; first += piece) {
    const uint32_t end = std::min(first + piece, copy.size);
    if (std::find(begin + first, begin + end, true) == begin + end) continue;
    if (!parts.empty() && first - parts.back().end <= gap)
      parts.back().end = end;
    else
      parts.push_back({first, end});
  }
  return parts;
}

rung_copy cut(const rung_copy& copy, uint32_t first, uint32_t end) {
  return {.kind = copy.kind,
          .from = copy.from + first,
          .to = copy.to + first,
          .mask = copy.kind == RUNG_COPY_MASKED ? copy.mask + first : copy.mask,
          .size = end - first};
}

void mark(std::vector<bool>& bytes, uint32_t offset, uint32_t size) { std::fill_n(bytes.begin() + offset, size, true); }

} // namespace

CopyLists::CopyLists(const rung_program& program, bool whole) : least_(whole ? RUNG_NONE : kLeast) {
  const std::span all(program.copies, program.copy_count);
  if (std::ranges::any_of(all, [&](const rung_copy& copy) { return copy.size >= least_; })) findTouched(program);
  for (const rung_task& task : std::span(program.tasks, program.task_count)) {
    const rt::NeededCopies::Range begin = add(all.subspan(task.begin_first, task.begin_count));
    tasks_.push_back({.begin = begin, .end = add(all.subspan(task.end_first, task.end_count))});
  }
}

void CopyLists::findTouched(const rung_program& program) {
  written_.resize(program.memory_size);
  for (const rung_written& w : std::span(program.writes, program.write_count)) mark(written_, w.offset, w.size);
  touched_ = written_;
  for (const rung_task& task : std::span(program.tasks, program.task_count))
    for (const rung_span& span : std::span(program.reads + task.read_first, task.read_count))
      mark(touched_, span.offset, span.size);
  for (const rung_span& span : std::span(program.retains, program.retain_count)) mark(touched_, span.offset, span.size);
  for (const rung_copy& copy : std::span(program.copies, program.copy_count))
    if (copy.kind == RUNG_COPY_ALL) mark(touched_, copy.from, copy.size);
}

rt::NeededCopies::Range CopyLists::add(std::span<const rung_copy> copies) {
  const auto first = static_cast<uint32_t>(copies_.size());
  for (const rung_copy& copy : copies)
    if (copy.size < least_)
      copies_.push_back(copy);
    else if (copy.kind == RUNG_COPY_ALL)
      addWhole(copy);
    else
      addMasked(copy);
  return {first, static_cast<uint32_t>(copies_.size()) - first};
}

void CopyLists::addWhole(const rung_copy& copy) {
  uint32_t end = 0; // of what is in a list
  for (const Part& part : partsOf(copy, touched_, copy.to, kPiece, kGap)) {
    if (part.first > end) leftOut_.push_back(cut(copy, end, part.first));
    copies_.push_back(cut(copy, part.first, part.end));
    end = part.end;
  }
  if (copy.size > end) leftOut_.push_back(cut(copy, end, copy.size));
}

// Where no chunk writes the mask, it is empty.
void CopyLists::addMasked(const rung_copy& copy) {
  for (const Part& part : partsOf(copy, written_, copy.mask, kMaskedPiece, kMaskedGap))
    copies_.push_back(cut(copy, part.first, part.end));
}

} // namespace rung::host
