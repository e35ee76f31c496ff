// One running program: its memory, context, queues, counters and virtual clock. The constructor allocates everything;
// starting, scanning and running tasks allocate nothing (hooks may).
//
// An instance belongs to one thread, except the host's side of `messages()` and `services()`.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/change/forcing.h"
#include "rtlib/change/replacement.h"
#include "rtlib/core/archive.h"
#include "rtlib/core/queues.h"
#include "rtlib/core/runner.h"
#include "rtlib/load/engine.h"
#include "rtlib/load/program_info.h"
#include "rtlib/load/ref.h"

namespace rung::runtime {

class Instance;

// The calls by which the control takes part in the schedule. onHook and onFault may run tasks. onLatch must not run
// tasks, but may write to the program's memory. respond is called within a task: it must not run tasks, and may read
// the program's memory but not write it.
class ScheduleHooks {
public:
  virtual ~ScheduleHooks() = default;
  virtual void onHook(Instance& instance, uint32_t work) { (void)instance, (void)work; }
  // The kinds of work for which onHook has something to do, a bit each; onHook is not called for the others. See
  // Instance::worksChanged.
  virtual uint32_t works() const { return ~0u; }
  // Called when a fault has been recorded and the outputs have their safe values. The hook may run tasks a last time;
  // their faults are ignored.
  virtual void onFault(Instance& instance) { (void)instance; }
  // Called at the beginning of a run of a task, together with its input copies: brings in what the task reads from
  // elsewhere. See setLatching.
  virtual void onLatch(Instance& instance, uint32_t task) { (void)instance, (void)task; }
  // Called after another program of the same dialect has taken over: places that were looked up in the former one are
  // invalid now.
  virtual void onReplace(Instance& instance) { (void)instance; }
  // Answers a service request at once. True: the reply is filled in, and the request does not enter the queue.
  virtual bool respond(Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
    (void)instance, (void)request, (void)reply;
    return false;
  }
};

// An observer that is called before and after each run of a task or of a part of one. It must not run tasks.
class TaskWatch {
public:
  virtual ~TaskWatch() = default;
  virtual void begins(const Instance& instance, uint32_t task) = 0;
  virtual void ended(const Instance& instance, uint32_t task) = 0;
};

// What an instance does at a call of its owner, or within a hook.
enum class PartKind : uint8_t {
  Scan,
  Slot,
  Slice,
  Fast,
  SliceToFast,
  Task,     // one run of a task
  Halt,     // it stops with a fault
  PowerOff, // its regular power-off begins
};

// An observer of everything that comes to a program from outside, in its order. It must not change the instance, and
// is called where nothing may allocate, lock or wait.
class OutsideWatch {
public:
  virtual ~OutsideWatch() = default;
  // Before and after a part. `number`: of the task or the fault, else RUNG_NONE.
  virtual void begins(const Instance& instance, PartKind kind, uint32_t number) noexcept = 0;
  virtual void ended(const Instance& instance) noexcept = 0;
  // Before and after a hook of the schedule or of a fault, and the copying of a run's inputs.
  virtual void withinBegins(const Instance& instance) noexcept = 0;
  virtual void withinEnded(const Instance& instance) noexcept = 0;
  // A request, before it is queued; `reply`, if it is not null, answers it at once or says that it is kept.
  virtual void requested(const Instance& instance, const core::ServiceRequest& request,
                         const core::ServiceReply* reply) noexcept = 0;
  // The part, or a hook in it, finds this reply.
  virtual void replied(const Instance& instance, const core::ServiceReply& reply) noexcept = 0;
  // The owner has written there, between two parts.
  virtual void written(const Instance& instance, uint32_t offset, uint32_t bytes) noexcept = 0;
  // The result of Instance::surroundings is another one.
  virtual void surroundingsChanged(const Instance& instance) noexcept = 0;
  // Memory, tickets or program are others than before: a start, a loaded state, a replacement.
  virtual void changedWhole(const Instance& instance) noexcept = 0;
};

// What of its owner's settings matters to a part.
struct Surroundings {
  uint32_t works = 0;      // ScheduleHooks::works
  bool latches = false;    // Instance::setLatching
  bool neededOnly = false; // Instance::setNeededCopiesOnly is in force
  bool operator==(const Surroundings&) const = default;
};

enum class LoadResult : uint8_t {
  Loaded,
  OtherProgram, // the state is that of another program, or of another version of it
  OtherForces,  // other cells are forced than when it was saved, or with other values
  Damaged,      // it is cut off, or says what cannot be; the instance is as after a cold start
};

class Instance {
public:
  // The program of `runnable` and the hooks outlive the instance. The instance starts cold.
  explicit Instance(const Runnable& runnable, ScheduleHooks* hooks = nullptr);
  // The same for a program whose chunks need no engine.
  explicit Instance(const rung_program& program, ScheduleHooks* hooks = nullptr) : Instance(Runnable{program}, hooks) {}
  // The same for the program of an engine, which outlives the instance; a program of the interpreter needs its engine.
  explicit Instance(Engine& engine, ScheduleHooks* hooks = nullptr)
      : Instance(Runnable{engine.program(), engine.context()}, hooks) {}
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const rung_program& program() const { return *loaded_.program; }
  void setHooks(ScheduleHooks* hooks) {
    hooks_ = hooks;
    setRunnerHooks();
  }
  // Asks ScheduleHooks::works again, because its result has changed. Not while the program runs.
  void worksChanged() { setRunnerHooks(); }
  void setTaskWatch(TaskWatch* watch);                // null: none, which costs nothing
  void setOutsideWatch(OutsideWatch* watch) noexcept; // null: none
  Surroundings surroundings() const {
    return {.works = hooks_ != nullptr ? hooks_->works() : 0,
            .latches = latching_ && hooks_ != nullptr,
            .neededOnly = runner_.copies() != nullptr};
  }
  void setLatching(bool latching); // whether onLatch is called; not at first

  // Whether process-image copies (task entry and exit) leave out bytes that no rung touches, for hosts that do not look
  // at those bytes; initially no. When this is switched off, the bytes left out are copied once. While a task watch is
  // set, everything is copied.
  void setNeededCopiesOnly(bool only) noexcept;
  bool neededCopiesOnly() const noexcept { return neededCopiesOnly_; }
  const core::NeededCopies& neededCopies() const noexcept { return loaded_.neededCopies; }
  const std::shared_ptr<const CopyLists>& copyLists() const noexcept { return loaded_.copyLists; }

  // Initializes the memory from the program's tables, empties the queues, clears the fault, and sets the schedule to
  // its beginning; clock and profile continue. The host's side of the queues may be used at the same time.
  void coldStart();
  // The same as coldStart, except that the retained spans keep their contents.
  void warmStart();

  // Replaces the program by that of `replacement`, with the state that both have in common (Replacement::transfer).
  // Clock, queues and tickets continue; profile counters start at 0; if the program had stopped on a fault, the new one
  // is stopped as well. Afterwards the replacement holds the former program: passing it again puts that program back,
  // and cells that only that program has begin as `own` says. If the result is not Replaced, nothing has happened.
  // Allocates nothing, except in onReplace.
  ReplaceResult replace(Replacement& replacement, OwnContents own = OwnContents::Initial);
  // The state between two scans, with everything on which further scans depend except the control, its host and the
  // code of forces: memory with the compiler's slots, clock, fault, runs that are cut into parts, tickets, requests and
  // replies. The same program has the same states on every engine and machine. `save` is for the scan thread and
  // allocates nothing; false: within a scan. `waiting`: with requests that the host has not taken and replies that the
  // program has not found, which may change meanwhile only if they are left out.
  bool save(core::Saver& saver, bool waiting = true) const noexcept;
  // Counts of lost messages and refused requests begin at 0 then. Nothing else may be using the host's side of the
  // queues, whose messages are dropped.
  LoadResult load(core::Loader& loader) noexcept;
  // The memory block in a saved state of the program; empty if it is none.
  static std::span<const uint8_t> blockIn(std::span<const uint8_t> state, const rung_program& program) noexcept;

  // The number of programs that have taken over. Places that were looked up under another number must be looked up
  // again.
  uint32_t generation() const { return generation_; }

  // Run the schedule from its present position to its end (scan) or to the end of a slot; fast runs the fast list once.
  // After a fault they do nothing.
  void scan();
  void slot();
  void fast();
  // Scans until the clock has advanced by at least `us`, or a fault stops the program.
  void runFor(int64_t us);
  // One run of a task by itself, outside the schedule. False: fault, unknown task, or called from within a task.
  bool runTask(uint32_t task);
  bool runTask(std::string_view name);
  // Stops the program with one of the faults that it declares, by its name or its number. False: it does not declare
  // this fault, or is stopped already.
  bool halt(std::string_view fault);
  bool halt(uint32_t fault);
  // Stops the program because the computer is too slow for it. False: it is stopped already.
  bool haltOverrun();
  // For a host on a real clock; see core::Runner.
  void setTimeLimit(core::TimeLimit limit) { runner_.setTimeLimit(limit); }
  uint32_t sliceDelayUs() const { return runner_.sliceDelayUs(); }
  void slice();
  bool fastAhead() const { return runner_.fastAhead(); }
  void sliceToFast();
  bool withinSlice() const { return runner_.withinSlice(); }

  // Puts forces in effect; see core::Runner. False: a fault has stopped the program.
  bool force(const Forcing& forcing) {
    runner_.force(forcing.code(), forcing.held());
    return !faulted();
  }
  void endForces() { runner_.endForces(); }
  bool forced() const { return !runner_.forced().empty(); }
  std::span<const core::ForcedBits> forcedBits() const { return runner_.forced(); } // of the block
  void hold() { runner_.hold(); }

  bool atListStart() const { return runner_.atListStart(); }
  int64_t nowUs() const { return ctx_->now_us; }
  void advanceClock(int64_t us) { runner_.advance(us); }
  void setStopped(bool stopped) { runner_.setStopped(stopped); }
  bool stopped() const { return runner_.stopped(); }

  bool faulted() const { return runner_.faulted(); }
  const rung_fault& fault() const { return ctx_->fault; }
  std::string faultText() const { return runtime::faultText(program(), ctx_->fault); }

  core::Memory memory() const { return {program(), loaded_.block.get()}; }
  std::span<uint8_t> block() { return {loaded_.block.get(), program().memory_size}; }
  std::span<const uint8_t> block() const { return {loaded_.block.get(), program().memory_size}; }
  uint64_t read(const Ref& ref) const { return readRaw(memory(), ref); }
  double readReal(const Ref& ref) const { return runtime::readReal(memory(), ref); }
  std::string readText(const Ref& ref) const { return runtime::readText(memory(), ref); }
  // Write a value between two scans, for the machine, a person or a test. An empty result: the value was written. If
  // another place is copied over `ref` before the program reads it, nothing is written, and the result is that other
  // place, where a value would last. (A control writes with writeRaw, which does not check this.)
  [[nodiscard]] std::optional<Ref> write(const Ref& ref, uint64_t value);
  [[nodiscard]] std::optional<Ref> writeReal(const Ref& ref, double value);
  [[nodiscard]] std::optional<Ref> writeText(const Ref& ref, std::string_view text);

  core::MessageQueue& messages() { return port_->messages; }
  const core::MessageQueue& messages() const { return port_->messages; }
  core::ServiceQueue& services() { return port_->services; }
  const core::ServiceQueue& services() const { return port_->services; }

  // The profile, one entry per rung; empty if the program is not instrumented.
  std::span<const rung_prof> profile() const { return loaded_.profile; }
  void clearProfile();

  // The contents of the retained spans, one after the other: what RetainStore saves. restoreRetained returns false if
  // the size is wrong.
  uint32_t retainedSize() const { return static_cast<uint32_t>(loaded_.retained.size()); }
  void copyRetained(std::span<uint8_t> to) const; // of retainedSize()
  bool restoreRetained(std::span<const uint8_t> from);

  const rung_ctx& context() const { return *ctx_; }

private:
  template <class Write>
  std::optional<Ref> writeAt(const Ref& ref, Write write);
  void noteWritten(const Ref& ref) noexcept;
  void setRunnerHooks();
  template <class Run>
  void runPart(PartKind kind, uint32_t number, Run run);
  void surroundingsChanged() noexcept;
  void useCopies() noexcept;
  void bringInLeftOut() noexcept;
  bool servicesAgree(const rung_program& next) const;
  void setServices() noexcept {
    port_->services.setServices(loaded_.services, loaded_.services != nullptr ? program().service_count : 0);
  }
  void resetRun();
  LoadResult checkState(core::Loader& loader) const noexcept;
  void loadState(core::Loader& loader) noexcept;
  bool hasOnlyBits() const noexcept;
  static void stepHook(void* self, uint32_t work);
  static void faultHook(void* self);
  static void latchHook(void* self, uint32_t task);
  static void taskHook(void* self, uint32_t task, bool begins);
  static bool respondHook(void* self, const core::ServiceRequest& request, core::ServiceReply& reply);

  LoadedProgram loaded_;
  ScheduleHooks* hooks_;
  TaskWatch* taskWatch_ = nullptr;
  OutsideWatch* outside_ = nullptr;
  bool latching_ = false;
  bool neededCopiesOnly_ = false;
  std::unique_ptr<rung_ctx> ctx_;
  std::unique_ptr<core::HostPort> port_;
  core::Runner runner_;
  uint32_t generation_ = 0;
};

} // namespace rung::runtime
