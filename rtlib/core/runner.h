// Runs a program's tasks and walks its schedule on the scan thread. Every loop is bounded: a task by its budget, a scan
// by its list of steps. Memory, context and part states are the caller's; the runner allocates nothing.
//
// Every run uses the floating-point settings that programs are compiled for, whatever settings the thread has.
//
// Parts. A run of a task that is cut into n parts takes exactly n RUNG_STEP_PART steps: part k stops at the first chunk
// border at or after the end of part k outside every subroutine, a jump over that border suspends at its target, and a
// run that ended early idles until its n steps are over, so that the schedule and the parts stay in phase.
//
// A fault stops everything: it is recorded in the context, the safe-state spans are zeroed, the fault hook is called
// once (it may run tasks), and from then on scans and tasks do nothing until `reset`.
#pragma once
#include <cstdint>
#include <span>

#include "rtlib/core/memory.h"
#include "rtlib/core/scan_steps.h"
#include "rung/program.h"

namespace rung::core {

// rung_fault::code when a chunk reported a fault without naming it, or returned a chunk that does not exist.
inline constexpr uint32_t kUndescribedFault = 0xFFFFFFFEu;
// Raised by the host: the computer is too slow for the program, see runtime::Pace.
inline constexpr uint32_t kOverrunFault = 0xFFFFFFFDu;
// Raised by the host: a slice exceeded its time limit.
inline constexpr uint32_t kMaxTimeFault = 0xFFFFFFFCu;

// The position of a run of a task that is cut into parts.
struct PartState {
  uint32_t pc = RUNG_PC_DONE;
  uint32_t part = 0; // the part that the next step runs; 0: a new run begins
  uint32_t budget = 0;
};

// The host's part of the schedule. Null functions are skipped.
struct RunnerHooks {
  void (*step)(void* data, uint32_t work) = nullptr; // RUNG_STEP_HOOK; may run tasks
  void (*fault)(void* data) = nullptr;               // after a fault; may run tasks
  void* data = nullptr;
  // Called before and after every run of a task or part, outside its process-image copies; must not run tasks.
  void (*task)(void* data, uint32_t task, bool begins) = nullptr;
  // Called before `task` at the beginning of a run: copies in what the run reads.
  void (*latch)(void* data, uint32_t task) = nullptr;
  uint32_t works = ~0u; // a bit for each work that `step` has to do; the others are skipped
};

// A time limit beside the budget of steps: how long a scan, a slot, a slice, the fast list or a single task may run. It
// is checked after every chunk.
struct TimeLimit {
  int64_t ns = 0; // 0: no limit
  int64_t (*nowNs)() = nullptr;
};

// Code for all chunks of a program: its own, or other code that runs in its place.
struct Code {
  const rung_chunk_fn* functions = nullptr; // by chunk
  void* engine = nullptr;                   // rung_ctx::engine
};

// Bits of a byte of the memory block that are held at a value.
struct ForcedBits {
  uint32_t offset = 0;
  uint8_t mask = 0;
  uint8_t value = 0;
};

class Runner {
public:
  // `parts` has an entry for each task. `engine` is rung_ctx::engine for the program's own code. `room` has space for
  // as many steps as rung_program::scan, whose joined steps are stored there; null: steps are not joined. All outlive
  // the runner.
  Runner(const rung_program& program, uint8_t* memory, rung_ctx& ctx, PartState* parts, void* engine = nullptr,
         rung_step* room = nullptr) noexcept;

  // Newly enabled works are done from the next scan on.
  void setHooks(RunnerHooks hooks) noexcept {
    hooks_ = hooks;
    joined_ = {};
    findPlain();
  }
  // The copies with which tasks begin and end, for the running program; null: all copies of the program's tables. They
  // outlive the runner.
  void setCopies(const NeededCopies* copies) noexcept {
    copies_ = copies;
    findPlain();
  }
  const NeededCopies* copies() const noexcept { return copies_; }
  // Anything that runs longer ends with kMaxTimeFault.
  void setTimeLimit(TimeLimit limit) noexcept { limit_ = limit; }
  // Another program takes over, between two scans, with its memory, part states and room. The clock continues, and a
  // fault stays. From then on the new objects must stay alive, and the former ones are no longer used.
  void setProgram(const rung_program& program, uint8_t* memory, PartState* parts, void* engine,
                  rung_step* room) noexcept;

  // From now on every reader within a scan finds the forced `bits` at their values, whatever copies and the control
  // write there; `code` ensures this for writes of chunks. To be called between two slices; lasts until `endForces`, a
  // fault, a stop, `reset` or `setProgram`. Both arguments outlive their use. Does nothing after a fault.
  void force(const Code& code, std::span<const ForcedBits> bits) noexcept;
  void endForces() noexcept;
  std::span<const ForcedBits> forced() const noexcept { return forced_; }
  // Restores the forced bits after other code has written to the memory.
  void hold() noexcept {
    if (!forced_.empty()) holdAll();
  }

  // Clears the fault, all runs under way and the position in the schedule; the clock continues.
  void reset() noexcept;
  // Continues from a saved state, whose clock, fault and part states are in the context and in `parts` already: between
  // two scans. Forces stay in effect.
  void resume(bool faulted, bool stopped) noexcept;

  // False: a fault has occurred, now or before, or the call comes from within a task.
  bool runTask(uint32_t task) noexcept;
  bool runPart(uint32_t task) noexcept;

  // Continue the schedule from its position to the end of the list, or to the end of a slot.
  void scan() noexcept;
  void slot() noexcept;
  // Runs the fast list from its beginning; the position in the scan list does not change.
  void fast() noexcept;

  // For a real clock: the time until the next slice, and the slice itself, which is one ADVANCE and the steps up to the
  // next ADVANCE or the end of the list. A scan of a list without ADVANCE takes a period of the main task, which passes
  // at its beginning. If the program has a list of slices, a scan that begins with a slice follows that list to its
  // end.
  uint32_t sliceDelayUs() const noexcept;
  void slice() noexcept;
  // Whether the fast task runs in the next slice.
  bool fastAhead() const noexcept;
  // Runs that slice up to and including the first run of the fast task; `slice` then runs the rest.
  void sliceToFast() noexcept;

  // The host stops the program with a fault. False: a fault has stopped it already, or a task is running.
  bool halt(uint32_t fault) noexcept;

  int64_t nowUs() const noexcept { return ctx_->now_us; }
  void advance(int64_t us) noexcept { ctx_->now_us += us; }
  bool atListStart() const noexcept { return position_ == 0; }
  // Whether `sliceToFast` has begun a slice whose rest is still to run.
  bool withinSlice() const noexcept { return position_ != 0 && list_[position_].op != RUNG_STEP_ADVANCE; }

  bool faulted() const noexcept { return faulted_; }
  const rung_fault& fault() const noexcept { return ctx_->fault; }
  // In a program stopped by the operator only the clock advances. Single tasks can still be run.
  void setStopped(bool stopped) noexcept {
    stopped_ = stopped;
    if (stopped) endForces();
  }
  bool stopped() const noexcept { return stopped_; }

private:
  bool copiesNothing(uint32_t task) const noexcept;
  void findPlain() noexcept; // to be called when the work at the beginning or end of runs changes
  bool runPlain(uint32_t task, uint32_t times) noexcept;
  uint32_t runRow(uint32_t entry, uint32_t times) noexcept;
  uint32_t runAgain(const rung_task& task, uint32_t times) noexcept;
  uint32_t runToEnd(const rung_task& t) noexcept;
  uint32_t runBounded(uint32_t pc, uint32_t limit) noexcept;
  uint32_t runFrom(uint32_t pc, uint32_t limit, const rung_task& t, uint32_t& budget) noexcept;
  uint32_t runCounted(uint32_t pc, uint32_t limit, const rung_task& task, uint32_t& budget) noexcept;
  void useCode(const Code& code) noexcept;
  // `Timed`: there is a time limit; without one the clock is not read.
  template <bool Timed>
  uint32_t runChunks(uint32_t pc, uint32_t limit, const rung_task& task, uint32_t& budget) noexcept;
  void startTime() noexcept {
    if (limit_.ns != 0) deadline_ = limit_.nowNs() + limit_.ns;
  }
  void holdAll() noexcept;
  bool isLate() const noexcept { return limit_.nowNs() > deadline_; }
  bool isFault(uint32_t pc) const noexcept;
  uint32_t overrun(const rung_task& task, const rung_chunk& chunk) noexcept;
  void latch(uint32_t task) noexcept;
  void begin(uint32_t task) noexcept;
  bool finish(uint32_t task, const rung_task& t, uint32_t pc) noexcept;
  void beginStack() noexcept;
  void copyBegin(uint32_t task, const rung_task& t) noexcept;
  void copyEnd(uint32_t task, const rung_task& t) noexcept;
  void copyBorder(uint32_t task, uint32_t first, uint32_t count,
                  NeededCopies::Range NeededCopies::Task::* needed) noexcept;
  void copyAll(std::span<const rung_copy> copies) noexcept;
  bool runWhole(uint32_t task, uint32_t times) noexcept;
  bool runWithBorders(uint32_t task, uint32_t times) noexcept;
  bool runNextPart(uint32_t task) noexcept;
  void doStep(const rung_step& step) noexcept;
  void doRareStep(const rung_step& step) noexcept;
  void stopOnFault(uint32_t task) noexcept;
  void clearSafes() noexcept;
  bool mayRun() const noexcept { return !faulted_ && !inTask_; }
  std::span<const rung_step> realTimeSchedule() const noexcept;
  std::span<const rung_step> untimedSchedule() noexcept;
  template <class Ends>
  void walk(std::span<const rung_step> list, const Ends& ends) noexcept;
  bool runsFast(const rung_step& step) const noexcept;

  void beginProgram() noexcept;

  const rung_program* program_;
  uint8_t* memory_;
  rung_ctx* ctx_;
  PartState* parts_;
  RunnerHooks hooks_;
  Code own_;  // the program's own
  Code code_; // the code that runs
  std::span<const ForcedBits> forced_;
  const NeededCopies* copies_ = nullptr;
  TimeLimit limit_;
  static constexpr uint32_t kMostPlain = 64; // tasks
  uint64_t plain_ = 0;                       // by task: a run without a limit consists of its chunks only
  int64_t deadline_ = 0;
  rung_step* room_;
  std::span<const rung_step> joined_; // rung_program::scan with joined steps; empty: not made yet
  std::span<const rung_step> list_;   // list of the current scan: rung_program::scan, joined_ or ::slices
  uint32_t position_ = 0;             // in it
  uint32_t untimedPeriodUs_ = 0;      // duration of a scan of a list without ADVANCE
  bool faulted_ = false;
  bool stopped_ = false;
  bool inTask_ = false;
  bool inHook_ = false; // a hook of the schedule is running
  bool inFaultHook_ = false;
  bool defaultFloats_ = false; // the settings of FloatEnvironment are in force
};

} // namespace rung::core
