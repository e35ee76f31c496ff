// The chunk loop, the process-image copies and the schedule.
#include "rtlib/core/runner.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstring>

#include "rtlib/core/float_environment.h"

namespace rung::core {

Runner::Runner(const rung_program& program, uint8_t* memory, rung_ctx& ctx, PartState* parts, void* engine,
               rung_step* room) noexcept
    : program_(&program), memory_(memory), ctx_(&ctx), parts_(parts), own_{program.chunk_fns, engine}, room_(room) {
  reset();
}

void Runner::setProgram(const rung_program& program, uint8_t* memory, PartState* parts, void* engine,
                        rung_step* room) noexcept {
  assert(!inTask_);
  program_ = &program;
  memory_ = memory;
  parts_ = parts;
  own_ = {program.chunk_fns, engine};
  room_ = room;
  joined_ = {};
  beginProgram();
}

void Runner::beginProgram() noexcept {
  endForces();
  bool timed = false;
  for (uint32_t i = 0; i < program_->scan_count; ++i) timed = timed || program_->scan[i].op == RUNG_STEP_ADVANCE;
  const bool hasPeriod = !timed && program_->main_task < program_->task_count;
  untimedPeriodUs_ = hasPeriod ? program_->tasks[program_->main_task].period_us : 0;
  for (uint32_t t = 0; t < program_->task_count; ++t) parts_[t] = {};
  ctx_->extra_weight = 0;
  position_ = 0;
  findPlain();
}

void Runner::reset() noexcept {
  assert(!inTask_);
  beginProgram();
  ctx_->fault = {RUNG_NONE, RUNG_NONE, 0, RUNG_NONE};
  faulted_ = false;
  stopped_ = false;
}

void Runner::resume(bool faulted, bool stopped) noexcept {
  assert(!inTask_);
  ctx_->extra_weight = 0;
  position_ = 0;
  faulted_ = faulted;
  stopped_ = stopped;
  if (faulted || stopped) endForces();
}

// ---- forces ------------------------------------------------------------------------------------------------------

void Runner::force(const Code& code, std::span<const ForcedBits> bits) noexcept {
  assert(!inTask_);
  if (faulted_) return;
  useCode(code);
  forced_ = bits;
  hold();
}

void Runner::endForces() noexcept {
  useCode(own_);
  forced_ = {};
}

void Runner::useCode(const Code& code) noexcept {
  code_ = code;
  ctx_->engine = code.engine;
}

void Runner::holdAll() noexcept {
  for (const ForcedBits& bits : forced_) {
    uint8_t& byte = memory_[bits.offset];
    byte = static_cast<uint8_t>((byte & ~bits.mask) | bits.value);
  }
}

// ---- tasks -------------------------------------------------------------------------------------------------------

inline void Runner::beginStack() noexcept {
  ctx_->stack[0] = RUNG_PC_DONE;
  ctx_->sp = 1;
}

namespace {

// Copies by units, of which the last may overlap the previous one. size >= sizeof(Unit).
template <class Unit>
void copyUnits(uint8_t* to, const uint8_t* from, uint32_t size) noexcept {
  for (uint32_t b = 0; b + sizeof(Unit) < size; b += sizeof(Unit)) std::memcpy(to + b, from + b, sizeof(Unit));
  std::memcpy(to + size - sizeof(Unit), from + size - sizeof(Unit), sizeof(Unit));
}

// Avoids the call of memcpy for short copies, which are the most frequent.
void copyBytes(uint8_t* to, const uint8_t* from, uint32_t size) noexcept {
  constexpr uint32_t kCallPays = 128;
  if (size > kCallPays)
    std::memcpy(to, from, size);
  else if (size >= 32)
    copyUnits<std::array<uint64_t, 4>>(to, from, size);
  else if (size >= 16)
    copyUnits<std::array<uint64_t, 2>>(to, from, size);
  else if (size >= 8)
    copyUnits<uint64_t>(to, from, size);
  else if (size >= 4)
    copyUnits<uint32_t>(to, from, size);
  else
    for (uint32_t b = 0; b < size; ++b) to[b] = from[b];
}

constexpr uint32_t kLine = 64; // bytes of a cache line

bool isEmpty(const uint8_t* line) noexcept {
  uint64_t words[kLine / 8];
  std::memcpy(words, line, sizeof words);
  uint64_t any = 0;
  for (const uint64_t word : words) any |= word;
  return any == 0;
}

// Merges all bytes of `Line` at once, so that the compiler uses wide registers.
template <class Line>
void mergeLine(uint8_t* to, const uint8_t* from, uint8_t* mask) noexcept {
  Line bits{}, old{}, fresh{};
  std::memcpy(&bits, mask, sizeof bits);
  std::memcpy(&old, to, sizeof old);
  std::memcpy(&fresh, from, sizeof fresh);
  for (size_t i = 0; i < bits.size(); ++i)
    old[i] = static_cast<typename Line::value_type>((old[i] & ~bits[i]) | (fresh[i] & bits[i]));
  std::memcpy(to, &old, sizeof old);
  std::memset(mask, 0, sizeof bits);
}

// Masks are long and nearly empty: they are tested line by line, and only lines with set bits are merged.
void copyMasked(uint8_t* to, const uint8_t* from, uint8_t* mask, uint32_t size) noexcept {
  uint32_t b = 0;
  for (; b + kLine <= size; b += kLine)
    if (!isEmpty(mask + b)) mergeLine<std::array<uint64_t, kLine / 8>>(to + b, from + b, mask + b);
  for (; b < size; ++b) mergeLine<std::array<uint8_t, 1>>(to + b, from + b, mask + b);
}

} // namespace

void Runner::copyAll(std::span<const rung_copy> copies) noexcept {
  uint8_t* const memory = memory_; // a local copy, because the compiler must assume that the writes change memory_
  for (const rung_copy& c : copies)
    if (c.kind == RUNG_COPY_ALL)
      copyBytes(memory + c.to, memory + c.from, c.size);
    else
      copyMasked(memory + c.to, memory + c.from, memory + c.mask, c.size);
  hold();
}

inline void Runner::copyBorder(uint32_t task, uint32_t first, uint32_t count,
                               NeededCopies::Range NeededCopies::Task::* needed) noexcept {
  if (count == 0) return;
  copyAll(copies_ != nullptr ? copies_->of(copies_->tasks[task].*needed)
                             : std::span<const rung_copy>(program_->copies + first, count));
}

inline void Runner::copyBegin(uint32_t task, const rung_task& t) noexcept {
  copyBorder(task, t.begin_first, t.begin_count, &NeededCopies::Task::begin);
}

inline void Runner::copyEnd(uint32_t task, const rung_task& t) noexcept {
  copyBorder(task, t.end_first, t.end_count, &NeededCopies::Task::end);
}

namespace {

// Another thread of the host may exchange a function, by code with the same effect, while chunks run. The tables of a
// loaded program are constants, for which an atomic load costs nothing more.
rung_chunk_fn functionOf(const rung_chunk_fn* functions, uint32_t chunk) noexcept {
  return std::atomic_ref<rung_chunk_fn>(const_cast<rung_chunk_fn&>(functions[chunk])).load(std::memory_order_acquire);
}

// Whether the compiler has found that no path through the task uses up its budget. (`longest` is limited to the budget,
// so if it equals the budget, the path may be longer.)
bool isBounded(const rung_task& task) noexcept {
  return task.loops == 0 && uint64_t{task.longest} * task.part_count < task.budget;
}

} // namespace

// As runChunks, for a bounded task without a time limit.
inline uint32_t Runner::runBounded(uint32_t pc, uint32_t limit) noexcept {
  uint8_t* const memory = memory_;
  rung_ctx* const ctx = ctx_;
  const rung_chunk_fn* const functions = code_.functions;
  const uint32_t count = program_->chunk_count;
  const uint32_t first = std::min(limit, count);
  for (;;) {
    while (pc < first) pc = functionOf(functions, pc)(memory, ctx, pc);
    if (pc >= count || ctx->sp == 1) return pc;
    pc = functionOf(functions, pc)(memory, ctx, pc);
  }
}

// A pc that is neither a chunk nor DONE counts as a fault, too.
inline bool Runner::isFault(uint32_t pc) const noexcept { return pc != RUNG_PC_DONE && pc >= program_->chunk_count; }

uint32_t Runner::overrun(const rung_task& task, const rung_chunk& chunk) noexcept {
  ctx_->fault.code = task.budget_fault;
  ctx_->fault.rung = chunk.first_rung;
  ctx_->fault.line = 0;
  return RUNG_PC_FAULT;
}

// Runs from `pc` to the end of the run, a fault, or a chunk at or after `limit` outside every subroutine.
template <bool Timed>
uint32_t Runner::runChunks(uint32_t pc, uint32_t limit, const rung_task& task, uint32_t& budget) noexcept {
  uint8_t* const memory = memory_;
  rung_ctx* const ctx = ctx_;
  const rung_chunk* const chunks = program_->chunks;
  const rung_chunk_fn* const functions = code_.functions;
  const uint32_t count = program_->chunk_count;
  const uint32_t first = std::min(limit, count); // first chunk at which the run may end
  uint32_t left = budget;
  ctx->extra_weight = 0;
  for (;;) {
    if (pc >= first && (pc >= count || ctx->sp == 1)) [[unlikely]]
      break;
    const uint32_t here = pc;
    const rung_chunk& chunk = chunks[here];
    if (chunk.weight > left) [[unlikely]]
      return overrun(task, chunk);
    left -= chunk.weight;
    pc = functionOf(functions, here)(memory, ctx, here);
    if constexpr (Timed)
      if (isLate()) {
        const uint32_t stopped = overrun(task, chunk);
        ctx->fault.code = kMaxTimeFault;
        return stopped;
      }
    const uint32_t extra = ctx->extra_weight;
    if (extra != 0) {
      ctx->extra_weight = 0;
      if (extra > left) return overrun(task, chunk);
      left -= extra;
    }
  }
  budget = left;
  return pc;
}

inline void Runner::latch(uint32_t task) noexcept {
  if (hooks_.latch == nullptr) return;
  hooks_.latch(hooks_.data, task);
  hold();
}

inline void Runner::begin(uint32_t task) noexcept {
  inTask_ = true;
  if (hooks_.task != nullptr) hooks_.task(hooks_.data, task, true);
}

// The work after the chunks of a run or a part.
inline bool Runner::finish(uint32_t task, const rung_task& t, uint32_t pc) noexcept {
  const bool fault = isFault(pc);
  if (!fault) copyEnd(task, t);
  if (hooks_.task != nullptr) hooks_.task(hooks_.data, task, false);
  inTask_ = false;
  if (fault) stopOnFault(task);
  return !fault;
}

// Tasks run by a hook count toward the time of its slice.
bool Runner::runTask(uint32_t task) noexcept {
  const FloatEnvironment environment(defaultFloats_);
  if (!inHook_) startTime();
  hold();
  return runWhole(task, 1);
}

bool Runner::runPart(uint32_t task) noexcept {
  const FloatEnvironment environment(defaultFloats_);
  hold();
  return runNextPart(task);
}

inline uint32_t Runner::runFrom(uint32_t pc, uint32_t limit, const rung_task& t, uint32_t& budget) noexcept {
  if (limit_.ns != 0) return runChunks<true>(pc, limit, t, budget);
  return isBounded(t) ? runBounded(pc, limit) : runCounted(pc, limit, t, budget);
}

// Counts the budget only while there may be loops; the code after them usually costs far less than the remaining
// budget.
uint32_t Runner::runCounted(uint32_t pc, uint32_t limit, const rung_task& task, uint32_t& budget) noexcept {
  if (task.loop_free_chunk < limit) {
    pc = runChunks<false>(pc, task.loop_free_chunk, task, budget);
    if (pc >= program_->chunk_count) return pc;
    if (task.loop_free_weight <= budget) return runBounded(pc, limit);
  }
  return runChunks<false>(pc, limit, task, budget);
}

inline uint32_t Runner::runToEnd(const rung_task& t) noexcept {
  beginStack();
  uint32_t budget = t.budget;
  return runFrom(t.entry, RUNG_PC_DONE, t, budget);
}

bool Runner::copiesNothing(uint32_t task) const noexcept {
  const rung_task& t = program_->tasks[task];
  if (t.begin_count + t.end_count == 0) return true;
  if (copies_ == nullptr) return false;
  const NeededCopies::Task& needed = copies_->tasks[task];
  return needed.begin.count + needed.end.count == 0;
}

void Runner::findPlain() noexcept {
  plain_ = 0;
  if (hooks_.latch != nullptr || hooks_.task != nullptr) return;
  for (uint32_t t = 0; t < std::min(program_->task_count, kMostPlain); ++t)
    if (copiesNothing(t) && isBounded(program_->tasks[t])) plain_ |= uint64_t{1} << t;
}

namespace {

// Contents of the memory block, stored for a later comparison.
class Contents {
public:
  // `words` has at most RUNG_MOST_CHANGES elements. NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): only as
  // many elements as `words` are used
  Contents(const uint8_t* memory, std::span<const uint32_t> words) noexcept : memory_(memory), words_(words) {
    for (size_t i = 0; i < words_.size(); ++i) before_[i] = wordAt(words_[i]);
  }
  bool still() const noexcept {
    uint64_t different = 0;
    for (size_t i = 0; i < words_.size(); ++i) different |= before_[i] ^ wordAt(words_[i]);
    return different == 0;
  }

private:
  uint64_t wordAt(uint32_t offset) const noexcept {
    uint64_t word = 0;
    std::memcpy(&word, memory_ + offset, sizeof word);
    return word;
  }
  const uint8_t* memory_;
  std::span<const uint32_t> words_;
  std::array<uint64_t, RUNG_MOST_CHANGES> before_;
};

} // namespace

// Runs the task `times` times, at least once, until it is stopped. Usually a run is a single chunk.
inline uint32_t Runner::runRow(uint32_t entry, uint32_t times) noexcept {
  uint8_t* const memory = memory_;
  rung_ctx* const ctx = ctx_;
  const uint32_t count = program_->chunk_count;
  for (;;) {
    beginStack();
    uint32_t pc = functionOf(code_.functions, entry)(memory, ctx, entry);
    if (pc < count) pc = runBounded(pc, RUNG_PC_DONE);
    if (pc != RUNG_PC_DONE || --times == 0 || stopped_) return pc;
  }
}

// Runs the task `times` times in succession. The first run may have new inputs, but once a later run has changed
// nothing, the remaining ones would not either, and are skipped.
uint32_t Runner::runAgain(const rung_task& task, uint32_t times) noexcept {
  if (times == 1 || task.change_count == 0) return runRow(task.entry, times);
  const Contents before(memory_, {program_->changes + task.change_first, task.change_count});
  const uint32_t pc = runRow(task.entry, 1);
  return pc != RUNG_PC_DONE || stopped_ || before.still() ? pc : runRow(task.entry, times - 1);
}

// Plain runs in succession, at the same time of the program's clock.
bool Runner::runPlain(uint32_t task, uint32_t times) noexcept {
  const rung_task& t = program_->tasks[task];
  inTask_ = true;
  uint32_t pc = runRow(t.entry, 1);
  if (times > 1 && pc == RUNG_PC_DONE && !stopped_) pc = runAgain(t, times - 1);
  inTask_ = false;
  if (pc != RUNG_PC_DONE) stopOnFault(task);
  return pc == RUNG_PC_DONE;
}

bool Runner::runWithBorders(uint32_t task, uint32_t times) noexcept {
  const rung_task& t = program_->tasks[task];
  for (;;) {
    latch(task);
    begin(task);
    copyBegin(task, t);
    if (!finish(task, t, runToEnd(t))) return false;
    if (--times == 0 || stopped_) return true;
  }
}

// Inlined, while the two kinds of runs are not, so that each saves only the registers that it needs.
inline bool Runner::runWhole(uint32_t task, uint32_t times) noexcept {
  if (!mayRun() || task >= program_->task_count || times == 0) return false;
  const bool isPlain = task < kMostPlain && (plain_ >> task & 1) != 0 && limit_.ns == 0;
  return isPlain ? runPlain(task, times) : runWithBorders(task, times);
}

bool Runner::runNextPart(uint32_t task) noexcept {
  if (!mayRun() || task >= program_->task_count) return false;
  const rung_task& t = program_->tasks[task];
  if (t.part_count == 1) return runWhole(task, 1);
  PartState& state = parts_[task];
  if (state.part == 0) latch(task);
  begin(task);
  if (state.part == 0) {
    copyBegin(task, t);
    state.pc = t.entry;
    state.budget = t.budget;
  }
  // A jump may have skipped parts: the run continues up to the first border that is still ahead.
  uint32_t limit = RUNG_PC_DONE;
  for (uint32_t k = state.part; k < t.part_count; ++k) {
    if (program_->part_ends[t.part_first + k] <= state.pc) continue;
    limit = program_->part_ends[t.part_first + k];
    break;
  }
  state.part = state.part + 1 < t.part_count ? state.part + 1 : 0;
  if (state.part == 0) limit = RUNG_PC_DONE; // the last step ends the run, whatever was skipped
  beginStack();
  state.pc = runFrom(state.pc, limit, t, state.budget);
  return finish(task, t, state.pc);
}

void Runner::clearSafes() noexcept {
  for (uint32_t i = 0; i < program_->safe_count; ++i)
    std::memset(memory_ + program_->safe_spans[i].offset, 0, program_->safe_spans[i].size);
}

void Runner::stopOnFault(uint32_t task) noexcept {
  ctx_->fault.task = task;
  if (ctx_->fault.code == RUNG_NONE) ctx_->fault.code = kUndescribedFault;
  faulted_ = true;
  if (inFaultHook_) return; // a fault of a run in the fault hook; the first fault stays recorded
  endForces();              // before the outputs get their safe values
  clearSafes();
  if (hooks_.fault == nullptr) return;
  const rung_fault first = ctx_->fault;
  inFaultHook_ = true;
  faulted_ = false;
  startTime(); // for tasks run by the hook
  hooks_.fault(hooks_.data);
  faulted_ = true;
  inFaultHook_ = false;
  ctx_->fault = first;
}

bool Runner::halt(uint32_t fault) noexcept {
  if (!mayRun()) return false;
  ctx_->fault = {fault, RUNG_NONE, 0, RUNG_NONE};
  stopOnFault(RUNG_NONE);
  return true;
}

// ---- schedule ----------------------------------------------------------------------------------------------------

// Most steps are of these two kinds: a schedule with a fast task has both for each of its runs.
inline void Runner::doStep(const rung_step& step) noexcept {
  if (step.op == RUNG_STEP_ADVANCE) return advance(step.arg);
  if (step.op != RUNG_STEP_RUN) return doRareStep(step);
  if (!stopped_) runWhole(step.task, step.arg);
}

// Not inlined, so that the frequent steps need no stack frame.
[[gnu::noinline]] void Runner::doRareStep(const rung_step& step) noexcept {
  if (step.op == RUNG_STEP_PART && !stopped_) runNextPart(step.task);
  if (step.op != RUNG_STEP_HOOK || isIdle(step, hooks_.works) || stopped_ || hooks_.step == nullptr) return;
  inHook_ = true;
  hooks_.step(hooks_.data, step.arg);
  inHook_ = false;
  hold();
}

// The steps of the current scan; between scans, those of the next one.
std::span<const rung_step> Runner::realTimeSchedule() const noexcept {
  if (position_ != 0) return list_;
  if (program_->slice_count != 0) return {program_->slices, program_->slice_count};
  return {program_->scan, program_->scan_count};
}

// The same for a scan without a real clock.
std::span<const rung_step> Runner::untimedSchedule() noexcept {
  if (position_ != 0) return list_;
  if (joined_.empty()) {
    joined_ = {program_->scan, program_->scan_count};
    if (room_ != nullptr) joined_ = {room_, joinSteps(joined_, hooks_.works, room_)};
  }
  return joined_;
}

// Runs the steps of the current scan up to its end, a fault, or a step after which `ends` returns true; it is called if
// another step follows.
template <class Ends>
inline void Runner::walk(std::span<const rung_step> list, const Ends& ends) noexcept {
  const FloatEnvironment environment(defaultFloats_);
  startTime();
  hold();
  list_ = list;
  if (faulted_) return;
  if (position_ == 0) advance(untimedPeriodUs_);
  uint32_t at = position_;
  while (at < list.size()) {
    position_ = at;
    const rung_step& step = list[at++];
    doStep(step);
    if (faulted_ || (at < list.size() && ends(step, list[at]))) break;
  }
  position_ = at < list.size() ? at : 0;
}

void Runner::scan() noexcept {
  walk(untimedSchedule(), [](const rung_step&, const rung_step&) { return false; });
}

void Runner::slot() noexcept {
  walk(untimedSchedule(), [](const rung_step& step, const rung_step&) { return step.op == RUNG_STEP_SLOT; });
}

void Runner::fast() noexcept {
  const FloatEnvironment environment(defaultFloats_);
  startTime();
  hold();
  for (uint32_t i = 0; i < program_->fast_count && !faulted_; ++i) doStep(program_->fast[i]);
}

uint32_t Runner::sliceDelayUs() const noexcept {
  if (position_ == 0 && untimedPeriodUs_ != 0) return untimedPeriodUs_;
  const std::span<const rung_step> list = realTimeSchedule();
  const bool waits = position_ < list.size() && list[position_].op == RUNG_STEP_ADVANCE;
  return waits ? list[position_].arg : 0;
}

void Runner::slice() noexcept {
  walk(realTimeSchedule(), [](const rung_step&, const rung_step& next) { return next.op == RUNG_STEP_ADVANCE; });
}

bool Runner::runsFast(const rung_step& step) const noexcept {
  return step.op == RUNG_STEP_RUN && step.task == program_->fast_task;
}

bool Runner::fastAhead() const noexcept {
  if (withinSlice()) return false;
  const std::span<const rung_step> list = realTimeSchedule();
  for (uint32_t i = position_; i < list.size(); ++i) {
    if (i > position_ && list[i].op == RUNG_STEP_ADVANCE) return false;
    if (runsFast(list[i])) return true;
  }
  return false;
}

void Runner::sliceToFast() noexcept {
  if (fastAhead()) walk(realTimeSchedule(), [this](const rung_step& step, const rung_step&) { return runsFast(step); });
}

} // namespace rung::core
