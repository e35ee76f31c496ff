// One running program: its memory, context, queues, counters and virtual clock. Everything is allocated when it is
// made; starting, scanning and running tasks allocate nothing (what hooks do is theirs).
//
// An instance belongs to one thread, but for the host's side of `messages()` and `services()`.
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
#include "rtlib/core/queues.h"
#include "rtlib/core/runner.h"
#include "rtlib/load/engine.h"
#include "rtlib/load/program_info.h"
#include "rtlib/load/ref.h"

namespace rung::runtime {

class Instance;

// The control's place in the schedule. onHook and onFault may run tasks; onLatch runs none, and may write to the
// program's memory; respond runs inside a task: it may run none, and it may read the program's memory but not write it.
class ScheduleHooks {
public:
  virtual ~ScheduleHooks() = default;
  virtual void onHook(Instance& instance, uint32_t work) { (void)instance, (void)work; }
  // What onHook has something to do for, a bit each; it is not called for the others. See Instance::worksChanged.
  virtual uint32_t works() const { return ~0u; }
  // The fault is recorded and the outputs are safe. Tasks run here a last time; faults of theirs are ignored.
  virtual void onFault(Instance& instance) { (void)instance; }
  // A run of a task begins, with its input copies: what it reads from elsewhere is brought in. See setLatching.
  virtual void onLatch(Instance& instance, uint32_t task) { (void)instance, (void)task; }
  // Another program has taken over, of the same dialect: places that were looked up in the former one mean nothing now.
  virtual void onReplace(Instance& instance) { (void)instance; }
  // True: the reply is filled in and the request does not enter the queue.
  virtual bool respond(Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
    (void)instance, (void)request, (void)reply;
    return false;
  }
};

// Looks on while tasks run: both calls are around a run of a task or a part. They run no task.
class TaskWatch {
public:
  virtual ~TaskWatch() = default;
  virtual void begins(const Instance& instance, uint32_t task) = 0;
  virtual void ended(const Instance& instance, uint32_t task) = 0;
};

class Instance {
public:
  // What it runs and the hooks outlive the instance. It starts cold.
  explicit Instance(const Runnable& runnable, ScheduleHooks* hooks = nullptr);
  // A program without an engine of its own.
  explicit Instance(const rung_program& program, ScheduleHooks* hooks = nullptr) : Instance(Runnable{program}, hooks) {}
  // The same of an engine, which outlives the instance; an interpreter's program needs it.
  explicit Instance(Engine& engine, ScheduleHooks* hooks = nullptr)
      : Instance(Runnable{engine.program(), engine.context()}, hooks) {}
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const rung_program& program() const { return *loaded_.program; }
  void setHooks(ScheduleHooks* hooks) {
    hooks_ = hooks;
    setRunnerHooks();
  }
  // ScheduleHooks::works says something else than when it was asked for last. Not while the program runs.
  void worksChanged() { setRunnerHooks(); }
  void setTaskWatch(TaskWatch* watch); // null: none, which costs nothing
  void setLatching(bool latching);     // whether onLatch is called; not at first

  // Whether tasks copy, at their borders, only what rungs touch, for hosts that look at none of the bytes that are left
  // out; not at first. When that ends, these are brought in. While a task watch looks on, all is copied.
  void setNeededCopiesOnly(bool only) noexcept;
  bool neededCopiesOnly() const noexcept { return neededCopiesOnly_; }
  const core::NeededCopies& neededCopies() const noexcept { return loaded_.neededCopies; }
  const std::shared_ptr<const CopyLists>& copyLists() const noexcept { return loaded_.copyLists; }

  // Memory as the program's tables say, queues empty, no fault, schedule at its beginning; clock and profile continue.
  // The host's side of the queues may be active meanwhile.
  void coldStart();
  // The same, but the retained spans keep their contents.
  void warmStart();

  // Another program takes over, with the state that it has in common with this one (Replacement::transfer). Clock,
  // queues and tickets continue, profile counters start at 0, and a program that had stopped on a fault stays stopped,
  // as the new one. The replacement then holds the former program: given again, it puts that back, and cells that only
  // that one has begin as `own` says. If the result is not Replaced, nothing has happened. Allocates nothing, but for
  // what onReplace does.
  ReplaceResult replace(Replacement& replacement, OwnContents own = OwnContents::Initial);
  // How many programs have taken over: what was looked up under another number is to be looked up again.
  uint32_t generation() const { return generation_; }

  // From the present place of the schedule: to its end, to the end of a slot; one run of the fast list. Nothing after a
  // fault.
  void scan();
  void slot();
  void fast();
  // Scans until the clock has advanced by at least `us`, or a fault stops the program.
  void runFor(int64_t us);
  // One run of a task by itself, outside the schedule. False: fault, unknown task, or called from within a task.
  bool runTask(uint32_t task);
  bool runTask(std::string_view name);
  // Stops the program with one of its own faults. False: it has no such fault, or is stopped already.
  bool halt(std::string_view fault);
  // The machine is too slow for it. False: it is stopped already.
  bool haltOverrun();
  // For a real clock; see core::Runner.
  void setTimeLimit(core::TimeLimit limit) { runner_.setTimeLimit(limit); }
  uint32_t sliceDelayUs() const { return runner_.sliceDelayUs(); }
  void slice();
  bool fastAhead() const { return runner_.fastAhead(); }
  void sliceToFast();
  bool withinSlice() const { return runner_.withinSlice(); }

  // See core::Runner. False: a fault has stopped the program.
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
  // What the machine, a person or a test writes between two scans. Each gives nothing when the value is written. Where
  // another place is copied over `ref` before the program reads it, nothing is written, and that place is the result:
  // a value lasts there. (A control writes what it likes with writeRaw.)
  [[nodiscard]] std::optional<Ref> write(const Ref& ref, uint64_t value);
  [[nodiscard]] std::optional<Ref> writeReal(const Ref& ref, double value);
  [[nodiscard]] std::optional<Ref> writeText(const Ref& ref, std::string_view text);

  core::MessageQueue& messages() { return port_->messages; }
  const core::MessageQueue& messages() const { return port_->messages; }
  core::ServiceQueue& services() { return port_->services; }
  const core::ServiceQueue& services() const { return port_->services; }

  // One entry a rung; empty when the program is not instrumented.
  std::span<const rung_prof> profile() const { return loaded_.profile; }
  void clearProfile();

  // The retained spans, one after the other: what RetainStore keeps. restoreRetained is false when the size is wrong.
  uint32_t retainedSize() const { return static_cast<uint32_t>(loaded_.retained.size()); }
  void copyRetained(std::span<uint8_t> to) const; // of retainedSize()
  bool restoreRetained(std::span<const uint8_t> from);

  const rung_ctx& context() const { return *ctx_; }

private:
  void setRunnerHooks();
  void useCopies() noexcept;
  void bringInLeftOut() noexcept;
  bool servicesAgree(const rung_program& next) const;
  void setServices() noexcept {
    port_->services.setServices(loaded_.services, loaded_.services != nullptr ? program().service_count : 0);
  }
  void resetRun();
  static void stepHook(void* self, uint32_t work);
  static void faultHook(void* self);
  static void latchHook(void* self, uint32_t task);
  static void taskHook(void* self, uint32_t task, bool begins);
  static bool respondHook(void* self, const core::ServiceRequest& request, core::ServiceReply& reply);

  LoadedProgram loaded_;
  ScheduleHooks* hooks_;
  TaskWatch* taskWatch_ = nullptr;
  bool latching_ = false;
  bool neededCopiesOnly_ = false;
  std::unique_ptr<rung_ctx> ctx_;
  std::unique_ptr<core::HostPort> port_;
  core::Runner runner_;
  uint32_t generation_ = 0;
};

} // namespace rung::runtime
