// What of each copy is needed (see copy_lists.h).
#include "rtlib/run/copy_lists.h"

#include <algorithm>

namespace rung::runtime {
namespace {

constexpr uint32_t kLeast = 256; // bytes: shorter copies stay whole, as does a program that does not say what it reads
constexpr uint32_t kPiece = 64;  // bytes that are needed or not together: a line of the runner's loops

// Of a copy.
struct Part {
  uint32_t first = 0;
  uint32_t end = 0;
};

bool any(const std::vector<bool>& bytes, uint32_t first, uint32_t end) {
  while (first < end && !bytes[first]) ++first;
  return first < end;
}

// The pieces with needed bytes that come after `part`, as long as no more than one in between has none. False: there
// are none.
bool next(const rung_copy& copy, const std::vector<bool>& needed, uint32_t at, Part& part) {
  Part found{part.end, part.end};
  for (uint32_t first = part.end; first < copy.size; first += kPiece) {
    const uint32_t end = std::min(first + kPiece, copy.size);
    if (!any(needed, at + first, at + end)) continue;
    if (found.end == part.end)
      found.first = first;
    else if (first - found.end > kPiece)
      break;
    found.end = end;
  }
  const bool isThere = found.end != part.end;
  part = found;
  return isThere;
}

void addPart(std::vector<rung_copy>& list, rung_copy copy, const Part& part) {
  if (part.first == part.end) return;
  copy.from += part.first;
  copy.to += part.first;
  if (copy.kind == RUNG_COPY_MASKED) copy.mask += part.first;
  copy.size = part.end - part.first;
  list.push_back(copy);
}

// What the runs of a task read has at least what its copies take.
bool saysWhatItReads(const rung_program& program) {
  return std::ranges::all_of(std::span(program.tasks, program.task_count),
                             [](const rung_task& task) { return task.begin_count == 0 || task.read_count != 0; });
}

void mark(std::vector<bool>& bytes, uint32_t offset, uint32_t size) {
  for (uint32_t i = 0; i < size; ++i) bytes[offset + i] = true;
}

} // namespace

CopyLists::CopyLists(const rung_program& program, bool whole)
    : least_(whole || !saysWhatItReads(program) ? RUNG_NONE : kLeast), written_(program.memory_size),
      touched_(program.memory_size), tasks_(program.task_count) {
  const std::span all(program.copies, program.copy_count);
  if (std::ranges::any_of(all, [&](const rung_copy& copy) { return copy.size >= least_; })) findTouched(program);
  for (uint32_t t = 0; t < program.task_count; ++t) {
    const rung_task& task = program.tasks[t];
    tasks_[t].begin = add(all.subspan(task.begin_first, task.begin_count));
    tasks_[t].end = add(all.subspan(task.end_first, task.end_count));
  }
}

void CopyLists::findTouched(const rung_program& program) {
  for (const rung_written& w : std::span(program.writes, program.write_count)) {
    mark(written_, w.offset, w.size);
    mark(touched_, w.offset, w.size);
  }
  for (const rung_span& span : std::span(program.reads, program.read_count)) mark(touched_, span.offset, span.size);
  for (const rung_span& span : std::span(program.retains, program.retain_count)) mark(touched_, span.offset, span.size);
  for (const rung_copy& copy : std::span(program.copies, program.copy_count))
    if (copy.kind == RUNG_COPY_ALL) mark(touched_, copy.from, copy.size);
}

core::NeededCopies::Range CopyLists::add(std::span<const rung_copy> copies) {
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
  Part part;
  uint32_t end = 0; // of what is in a list
  while (next(copy, touched_, copy.to, part)) {
    addPart(leftOut_, copy, {end, part.first});
    addPart(copies_, copy, part);
    end = part.end;
  }
  addPart(leftOut_, copy, {end, copy.size});
}

// Where no chunk writes the mask, it is empty.
void CopyLists::addMasked(const rung_copy& copy) {
  Part part;
  while (next(copy, written_, copy.mask, part)) addPart(copies_, copy, part);
}

} // namespace rung::runtime
