// Running the parts of the schedule, and its state.
#include "rtlib/api/running.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "rtlib/api/error.h"
#include "rtlib/api/instance.h"
#include "rtlib/api/values.h"
#include "rtlib/load/program_info.h"
#include "rtlib/run/timer_state.h"

namespace rung::api {

namespace {

// Called after a part, so that a function that the host starts before the next slice begins with that slice, like
// earlier ones.
void stepFunctions(rung_instance& instance) noexcept {
  for (uint32_t left = instance.functionChannels; left != 0; left &= left - 1)
    instance.control->functions(static_cast<uint32_t>(std::countr_zero(left)))->step();
  instance.running.hold();
}

void endSlice(rung_instance& instance) noexcept {
  instance.environment->afterPart(instance.running);
  instance.running.hold();
  if (!instance.retention) return;
  const bool asked = instance.recorder && instance.control->asksToSave(instance.running);
  if (!instance.retention->afterSlice() && (instance.options.flags & RUNG_SAVE_AT_ONCE) != 0) {
    (void)instance.retention->flush();
    (void)instance.retention->afterSlice();
  }
  if (asked && !instance.control->asksToSave(instance.running)) instance.recorder->saved();
}

void takeChanges(rung_instance& instance) noexcept {
  rung_message message{};
  while (instance.control->nextChange(instance.running, message)) say(instance, message);
}

void sampleWatches(rung_instance& instance) noexcept {
  instance.bringInWhatIsSeen(); // their cells may be new
  instance.watches.sample(instance);
}

void endScan(rung_instance& instance) noexcept {
  takeChanges(instance);
  ++instance.scans;
  sampleWatches(instance);
  instance.lastPassNs = instance.passNs;
  instance.worstPassNs = std::max(instance.worstPassNs, instance.passNs);
  instance.passNs = 0;
}

} // namespace

// The rest of a slice keeps the inputs with which the slice began.
void beforePart(rung_instance& instance, runtime::PartKind kind, uint32_t number) noexcept {
  const bool begins = !instance.running.withinSlice();
  if (begins) {
    instance.structs.takeAll();
    if (!instance.inputs.empty()) readInputs(instance); // most hosts bind none
    instance.now().blockPlan.readRest(instance.running.block().data());
  }
  if (instance.recorder) instance.recorder->partBegins(kind, number, begins);
  if (begins) instance.environment->beforePart(instance.running);
}

namespace {

void endPart(rung_instance& instance) noexcept {
  runtime::Instance& running = instance.running;
  takeMessages(instance);
  const bool sliceEnds = !running.withinSlice() || running.faulted();
  if (sliceEnds) endSlice(instance);
  if (running.faulted()) {
    settleForces(instance);
    clearOutputs(instance);
    sampleWatches(instance);
    if (instance.recorder) instance.recorder->partEnds();
    putFormerBack(instance);
    reportFault(instance);
    return;
  }
  if (!instance.outputs.empty()) writeOutputs(instance);
  instance.now().blockPlan.write(running.block().data());
  if (running.atListStart()) endScan(instance);
  if (sliceEnds) stepFunctions(instance);
}

} // namespace

void afterPart(rung_instance& instance) noexcept {
  endPart(instance);
  if (instance.recorder) instance.recorder->partEnds();
}

void reportFault(rung_instance& instance) noexcept {
  if (!instance.running.faulted() || instance.faultReported) return;
  instance.faultReported = true;
  if (instance.options.fault != nullptr) instance.options.fault(instance.options.user, &instance);
}

int32_t checkMemory(const rung_program& program, const void* memory, size_t bytes) noexcept {
  if (memory == nullptr) return RUNG_OK;
  const uint32_t needed = std::max(program.memory_size, core::Memory::kLeastBlock);
  if (bytes < needed)
    return fail(RUNG_BAD_ARGUMENT, "the memory block has %zu bytes, the program needs %u", bytes, needed);
  if (reinterpret_cast<uintptr_t>(memory) % program.memory_align != 0)
    return fail(RUNG_BAD_ARGUMENT, "the memory block is not aligned to %u bytes", program.memory_align);
  return RUNG_OK;
}

namespace {

constexpr int64_t kHourNs = 3'600'000'000'000;

template <class Part>
int32_t runCall(rung_instance* handle, runtime::PartKind kind, Part part) noexcept {
  const Call call(handle, When::On);
  if (!call.ok()) return call.status();
  if (!call->running.faulted()) runPart(*call, kind, [&] { part(call->running); });
  return statusOf(*call);
}

// Advances the host's clock; `run` then runs the due slices.
template <class Run>
int32_t runElapsed(rung_instance* handle, int64_t elapsedNs, Run run) noexcept {
  const Call call(handle, When::On);
  if (!call.ok()) return call.status();
  if (elapsedNs < 0 || elapsedNs > kHourNs)
    return fail(RUNG_BAD_ARGUMENT, "the elapsed time is 0 to 3600000000000 ns, not %lld",
                static_cast<long long>(elapsedNs));
  if (!call->pace.hasPeriod())
    return fail(RUNG_WRONG_STATE, "the program's schedule has no period: run it by rung_instance_scan");
  call->pace.elapse(elapsedNs);
  run(*call);
  return statusOf(*call);
}

} // namespace

// Counters and times of rungs.

namespace {

rung_profile profileOf(const rung_instance& instance, uint32_t index) noexcept {
  const rung_program& program = instance.running.program();
  const rung_info& rung = program.rungs[index];
  const rung_prof& counters = instance.running.profile()[index];
  const runtime::ProfileClock& clock = instance.now().clock;
  const double ticks = static_cast<double>(counters.total) - static_cast<double>(counters.count) * clock.costTicks;
  const double longest = counters.count == 0 ? 0 : static_cast<double>(counters.max) - clock.costTicks;
  return {.rung = rung.number,
          .line = rung.first_line,
          .file = rung.file < program.file_count ? program.files[rung.file] : "",
          .title = rung.title,
          .runs = counters.count,
          .total_ns = std::max(0.0, ticks * clock.nsPerTick),
          .max_ns = std::max(0.0, longest * clock.nsPerTick)};
}

int32_t failProfile() noexcept {
  return fail(RUNG_WRONG_STATE, "the program does not count its rungs: build it with rungc build --profile");
}

} // namespace

} // namespace rung::api

using namespace rung;
using namespace rung::api;

int32_t rung_instance_slice(rung_instance* instance) {
  return runCall(instance, runtime::PartKind::Slice, [](runtime::Instance& running) { running.slice(); });
}
int32_t rung_instance_scan(rung_instance* instance) {
  return runCall(instance, runtime::PartKind::Scan, [](runtime::Instance& running) { running.scan(); });
}
int32_t rung_instance_slot(rung_instance* instance) {
  return runCall(instance, runtime::PartKind::Slot, [](runtime::Instance& running) { running.slot(); });
}
int32_t rung_instance_fast(rung_instance* instance) {
  return runCall(instance, runtime::PartKind::Fast, [](runtime::Instance& running) { running.fast(); });
}

int32_t rung_instance_run_due(rung_instance* instance, int64_t elapsed_ns) {
  return runElapsed(instance, elapsed_ns, [](rung_instance& due) {
    while (!due.running.faulted() && due.pace.take())
      runPart(due, runtime::PartKind::Slice, [&] { due.running.slice(); });
    if (due.pace.overloaded() && !due.running.faulted())
      runPart(due, runtime::PartKind::Halt, [&] { due.running.haltOverrun(); }, core::kOverrunFault);
  });
}

int32_t rung_instance_run_due_fast(rung_instance* instance, int64_t elapsed_ns) {
  return runElapsed(instance, elapsed_ns, [](rung_instance& due) {
    if (due.running.fastAhead() && due.pace.take())
      runPart(due, runtime::PartKind::SliceToFast, [&] { due.running.sliceToFast(); });
  });
}

int32_t rung_instance_sample(rung_instance* instance) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  call->bringInWhatIsSeen();
  call->watches.sampleNew(*call);
  return RUNG_OK;
}

int32_t rung_instance_limit(rung_instance* instance, int64_t ns) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (ns < 0 || ns > kHourNs)
    return fail(RUNG_BAD_ARGUMENT, "the limit is 0 to 3600000000000 ns, not %lld", static_cast<long long>(ns));
  call->running.setTimeLimit({.ns = ns, .nowNs = &runtime::monotonicNs});
  return RUNG_OK;
}

int32_t rung_instance_prefetch(const rung_instance* instance, int64_t until_ns) {
  const Call call(instance);
  if (call.ok()) call->now().image->footprint.prefetch(call->running.block().data(), until_ns);
  return call.status();
}

int32_t rung_instance_stop(rung_instance* instance) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  call->running.setStopped(true);
  if (call->recorder) call->recorder->stopped(true);
  settleForces(*call);
  return RUNG_OK;
}

int32_t rung_instance_start(rung_instance* instance) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  call->running.setStopped(false);
  if (call->recorder) call->recorder->stopped(false);
  return RUNG_OK;
}

namespace {

uint32_t flagsOf(const rung_instance& instance) noexcept {
  uint32_t flags = 0;
  if (instance.on) flags |= RUNG_STATE_ON;
  if (instance.running.stopped()) flags |= RUNG_STATE_STOPPED;
  if (instance.running.faulted()) flags |= RUNG_STATE_FAULTED;
  if (instance.running.atListStart()) flags |= RUNG_STATE_AT_START;
  if (instance.retention && instance.retention->memory().failing()) flags |= RUNG_STATE_UNSAVED;
  return flags;
}

} // namespace

int32_t rung_instance_state(const rung_instance* instance, rung_state* state) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  const runtime::Instance& running = call->running;
  const runtime::RetainedMemory* kept = call->retention ? &call->retention->memory() : nullptr;
  return giveStruct(state, rung_state{.flags = flagsOf(*call),
                                      .generation = running.generation(),
                                      .due_us = running.sliceDelayUs(),
                                      .now_us = running.nowUs(),
                                      .wait_ns = call->pace.untilNextNs(),
                                      .scans = call->scans,
                                      .missed = call->pace.missed(),
                                      .last_ns = call->lastPassNs,
                                      .worst_ns = call->worstPassNs,
                                      .lost_messages = running.messages().lost() + call->messages.lost(),
                                      .refused_requests = running.services().refused(),
                                      .stray_replies = running.services().stray(),
                                      .program = call->now().number,
                                      .saves = kept != nullptr ? kept->saved() : 0,
                                      .failed_saves = kept != nullptr ? kept->failed() : 0});
}

int32_t rung_instance_program(const rung_instance* instance, rung_program_info* program) {
  const rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  rung_program_info out{};
  handle->generations.look([&](const Generation& running) {
    out.number = running.number;
    putText(out.name, running.program().name);
    const Generation* faulted = handle->faulted.load(std::memory_order_acquire);
    if (faulted == nullptr || faulted == &running) return;
    out.faulted = faulted->number;
    putText(out.faulted_name, faulted->program().name);
  });
  return giveStruct(program, out);
}

int32_t rung_instance_fault(const rung_instance* instance, rung_fault_info* info) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  if (!call->running.faulted()) return RUNG_EMPTY;
  return contained([&] {
    const Generation* faulted = call->faulted;
    const rung_program& program = faulted != nullptr ? faulted->program() : call->running.program();
    const rung_fault& fault = faulted != nullptr ? call->fault : call->running.fault();
    rung_fault_info out{.line = fault.line, .code = "", .file = "", .task = ""};
    if (fault.code < program.fault_count) out.code = program.faults[fault.code];
    if (fault.code == core::kOverrunFault) out.code = "overrun";
    if (fault.code == core::kMaxTimeFault) out.code = "max-time";
    if (fault.task < program.task_count) out.task = program.tasks[fault.task].name;
    if (fault.rung < program.rung_count) {
      const rung_info& rung = program.rungs[fault.rung];
      out.rung = rung.number;
      if (rung.file < program.file_count) out.file = program.files[rung.file];
      if (out.line == 0) out.line = rung.first_line;
    }
    if (info != nullptr && info->size > offsetof(rung_fault_info, text))
      putText(out.text, runtime::faultText(program, fault));
    return giveStruct(info, out);
  });
}

using namespace rung::api;

int32_t rung_instance_profile(const rung_instance* instance, uint32_t index, rung_profile* profile) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  if (call->running.profile().empty()) return failProfile();
  if (index >= call->running.profile().size()) return RUNG_EMPTY;
  return giveStruct(profile, profileOf(*call, index));
}

int32_t rung_instance_timer(const rung_instance* instance, uint32_t index, rung_timer_info* timer) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  const rung_program& program = call->running.program();
  if (index >= program.timer_count) return RUNG_EMPTY;
  const rung_timer& entry = program.timers[index];
  const runtime::TimerState state = runtime::stateOf(call->running.memory(), entry);
  rung_timer_info out{.running = state.running ? 1u : 0u,
                      .runs = (entry.flags & RUNG_TIMER_RUNS) != 0 ? 1u : 0u,
                      .name = entry.name,
                      .file = "",
                      .title = "",
                      .elapsed = state.elapsed,
                      .remaining = state.remaining,
                      .preset = state.preset};
  if (entry.rung != RUNG_NONE) {
    const rung_info& rung = program.rungs[entry.rung];
    out.rung = rung.number;
    out.line = rung.first_line;
    out.title = rung.title;
    if (rung.file < program.file_count) out.file = program.files[rung.file];
  }
  return giveStruct(timer, out);
}

int32_t rung_instance_clear_profile(rung_instance* instance) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (call->running.profile().empty()) return failProfile();
  call->running.clearProfile();
  return RUNG_OK;
}

int32_t rung_instance_worst_rung(const rung_instance* instance, rung_profile* profile) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  const std::span<const rung_prof> all = call->running.profile();
  if (all.empty()) return failProfile();
  const auto worst = std::ranges::max_element(all, {}, &rung_prof::max);
  if (worst->count == 0) return RUNG_EMPTY;
  return giveStruct(profile, profileOf(*call, static_cast<uint32_t>(worst - all.begin())));
}
