// The memory of a program.
#include "rtlib/run/loaded_program.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <span>

#include "rtlib/load/block_bytes.h"
#include "rtlib/load/program_info.h"

namespace rung::runtime {

namespace {

uint32_t bytesFor(const Runnable& runnable, uint32_t leastBytes) {
  const uint32_t size = std::max(runnable.program.memory_size, core::Memory::kLeastBlock);
  return runnable.memory != nullptr ? size : std::max(size + size / 8, leastBytes);
}

// Aligned to at least a cache line.
uint32_t alignOf(const rung_program& program) { return std::max(program.memory_align, 64u); }

std::unique_ptr<uint8_t, LoadedProgram::FreeBlock> blockFor(const Runnable& runnable, uint32_t bytes) {
  using FreeBlock = LoadedProgram::FreeBlock;
  if (runnable.memory != nullptr) return {runnable.memory, FreeBlock{0}};
  const uint32_t align = alignOf(runnable.program);
  return {static_cast<uint8_t*>(::operator new(bytes, std::align_val_t{align})), FreeBlock{align}};
}

uint32_t retainedBytes(const rung_program& program) {
  uint32_t sum = 0;
  for (uint32_t i = 0; i < program.retain_count; ++i) sum += program.retains[i].size;
  return sum;
}

} // namespace

void LoadedProgram::FreeBlock::operator()(uint8_t* bytes) const {
  if (align != 0) ::operator delete(bytes, std::align_val_t{align});
}

LoadedProgram::LoadedProgram(const Runnable& runnable, uint32_t leastBytes)
    : program(&runnable.program), engine(runnable.engine), services(runnable.services),
      blockBytes(bytesFor(runnable, leastBytes)), block(blockFor(runnable, blockBytes)),
      profile(program->instrumented != 0 ? program->rung_count : 0), parts(program->task_count),
      steps(program->scan_count), retained(retainedBytes(*program)), overwritten(*program),
      copyLists(std::make_shared<const CopyLists>(*program, runnable.memory != nullptr)),
      neededCopies(copyLists->views()) {
  clear();
}

void LoadedProgram::clear() noexcept {
  std::memset(block.get(), 0, program->memory_size);
  for (uint32_t i = 0; i < program->init_count; ++i)
    std::memcpy(block.get() + program->inits[i].offset, program->inits[i].data, program->inits[i].size);
}

// The needed parts of each copy.

namespace {

constexpr uint32_t kLeast = 256; // bytes: shorter copies stay whole, as do those of a program without `reads`
constexpr uint32_t kPiece = 64;  // bytes that are kept or left out together: a line of the runner's loops

// A part of a copy.
struct Part {
  uint32_t first = 0;
  uint32_t end = 0;
};

bool any(const std::vector<bool>& bytes, uint32_t first, uint32_t end) {
  while (first < end && !bytes[first]) ++first;
  return first < end;
}

// Finds the next pieces with needed bytes after `part`, with gaps of at most one piece between them. False: there are
// none.
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

// Whether the program has lists of what its tasks read; a task with input copies then has a list that is not empty.
bool saysWhatItReads(const rung_program& program) {
  return std::ranges::all_of(std::span(program.tasks, program.task_count),
                             [](const rung_task& task) { return task.begin_count == 0 || task.read_count != 0; });
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
  touched_ = written_ = chunkBytes(program);
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
  uint32_t end = 0; // end of the part that is already in a list
  while (next(copy, touched_, copy.to, part)) {
    addPart(leftOut_, copy, {end, part.first});
    addPart(copies_, copy, part);
    end = part.end;
  }
  addPart(leftOut_, copy, {end, copy.size});
}

// Parts of the mask that no chunk writes are always empty.
void CopyLists::addMasked(const rung_copy& copy) {
  Part part;
  while (next(copy, written_, copy.mask, part)) addPart(copies_, copy, part);
}

// Finds overwritten places in the tables of the program.

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

// The input copy that writes this byte of the memory block; null if there is none. A place that the task restores at
// its end (registers saved by an interrupting task) is not overwritten.
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
