// Start-up, schedule and retained memory of an instance. After construction nothing here allocates.
#include "rtlib/run/instance.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "rtlib/load/block_bytes.h"

namespace rung::runtime {

Instance::Instance(const Runnable& runnable, ScheduleHooks* hooks)
    : loaded_(runnable), hooks_(hooks), ctx_(std::make_unique<rung_ctx>()), port_(std::make_unique<core::HostPort>()),
      runner_(runnable.program, loaded_.block.get(), *ctx_, loaded_.parts.data(), runnable.engine,
              loaded_.steps.data()) {
  ctx_->host = &core::hostApi();
  ctx_->host_data = port_.get();
  ctx_->prof = loaded_.counters();
  setRunnerHooks();
  port_->services.setResponder({&respondHook, this});
  setServices();
  coldStart();
}

// ---- writing -----------------------------------------------------------------------------------------------------

template <class Write>
std::optional<Ref> Instance::writeAt(const Ref& ref, Write write) {
  const std::optional<Ref> copied = loaded_.overwritten.source(ref);
  if (!copied) write(memory());
  hold();
  if (!copied && outside_ != nullptr) noteWritten(ref);
  return copied;
}

std::optional<Ref> Instance::write(const Ref& ref, uint64_t value) {
  return writeAt(ref, [&](const core::Memory& memory) { writeRaw(memory, ref, value); });
}

std::optional<Ref> Instance::writeReal(const Ref& ref, double value) {
  return writeAt(ref, [&](const core::Memory& memory) { runtime::writeReal(memory, ref, value); });
}

std::optional<Ref> Instance::writeText(const Ref& ref, std::string_view text) {
  return writeAt(ref, [&](const core::Memory& memory) { runtime::writeText(memory, ref, text); });
}

void Instance::noteWritten(const Ref& ref) noexcept {
  constexpr uint32_t kExpanded = 8; // bytes of the block for a byte whose bits have a byte each
  const uint32_t bytes = (ref.bit + ref.width * ref.count + 7) / 8;
  for (uint32_t i = 0; i < bytes; ++i) {
    const core::Place place = memory().locateBit(ref.space, ref.byte + i, 0);
    const rung_range* range = memory().rangeOf(ref.space, ref.byte + i);
    if (range != nullptr)
      outside_->written(*this, place.offset(), range->repr == RUNG_REPR_BYTE_PER_BIT ? kExpanded : 1);
  }
}

// ---- hooks -------------------------------------------------------------------------------------------------------

void Instance::stepHook(void* self, uint32_t work) {
  auto& instance = *static_cast<Instance*>(self);
  if (instance.hooks_ == nullptr) return;
  if (instance.outside_ != nullptr) instance.outside_->withinBegins(instance);
  instance.hooks_->onHook(instance, work);
  if (instance.outside_ != nullptr) instance.outside_->withinEnded(instance);
}

void Instance::faultHook(void* self) {
  auto& instance = *static_cast<Instance*>(self);
  if (instance.hooks_ == nullptr) return;
  if (instance.outside_ != nullptr) instance.outside_->withinBegins(instance);
  instance.hooks_->onFault(instance);
  if (instance.outside_ != nullptr) instance.outside_->withinEnded(instance);
}

void Instance::taskHook(void* self, uint32_t task, bool begins) {
  const auto& instance = *static_cast<const Instance*>(self);
  if (begins)
    instance.taskWatch_->begins(instance, task);
  else
    instance.taskWatch_->ended(instance, task);
}

void Instance::latchHook(void* self, uint32_t task) {
  auto& instance = *static_cast<Instance*>(self);
  if (instance.outside_ != nullptr) instance.outside_->withinBegins(instance);
  instance.hooks_->onLatch(instance, task);
  if (instance.outside_ != nullptr) instance.outside_->withinEnded(instance);
}

void Instance::setRunnerHooks() {
  runner_.setHooks({.step = &stepHook,
                    .fault = &faultHook,
                    .data = this,
                    .task = taskWatch_ == nullptr ? nullptr : &taskHook,
                    .latch = surroundings().latches ? &latchHook : nullptr,
                    .works = surroundings().works});
  surroundingsChanged();
}

void Instance::setOutsideWatch(OutsideWatch* watch) noexcept {
  outside_ = watch;
  const auto replied = [](void* self, const core::ServiceReply& reply) {
    const auto& instance = *static_cast<Instance*>(self);
    instance.outside_->replied(instance, reply);
  };
  port_->services.setObserver(watch == nullptr ? nullptr : +replied, this);
}

void Instance::surroundingsChanged() noexcept {
  if (outside_ != nullptr) outside_->surroundingsChanged(*this);
}

void Instance::setTaskWatch(TaskWatch* watch) {
  taskWatch_ = watch;
  setRunnerHooks();
  useCopies();
}

void Instance::setLatching(bool latching) {
  latching_ = latching;
  setRunnerHooks();
}

// ---- process-image copies ----------------------------------------------------------------------------------------

void Instance::setNeededCopiesOnly(bool only) noexcept {
  if (only == neededCopiesOnly_) return;
  neededCopiesOnly_ = only;
  useCopies();
}

void Instance::useCopies() noexcept {
  const bool only = neededCopiesOnly_ && taskWatch_ == nullptr;
  if (!only) bringInLeftOut();
  runner_.setCopies(only ? &loaded_.neededCopies : nullptr);
  surroundingsChanged();
}

void Instance::bringInLeftOut() noexcept {
  if (runner_.copies() == nullptr) return;
  loaded_.neededCopies.copyLeftOut(loaded_.block.get());
  hold();
}

// ---- requests ----------------------------------------------------------------------------------------------------

bool Instance::respondHook(void* self, const core::ServiceRequest& request, core::ServiceReply& reply) {
  auto& instance = *static_cast<Instance*>(self);
  const bool responded = instance.hooks_ != nullptr && instance.hooks_->respond(instance, request, reply);
  if (instance.outside_ != nullptr) instance.outside_->requested(instance, request, responded ? &reply : nullptr);
  return responded;
}

// ---- start -------------------------------------------------------------------------------------------------------

void Instance::resetRun() {
  runner_.reset();
  port_->messages.drop();
  port_->services.restart();
}

void Instance::coldStart() {
  loaded_.clear();
  resetRun();
  if (outside_ != nullptr) outside_->changedWhole(*this);
}

void Instance::warmStart() {
  copyRetained(loaded_.retained);
  loaded_.clear();
  resetRun();
  restoreRetained(loaded_.retained);
  if (outside_ != nullptr) outside_->changedWhole(*this);
}

void Instance::copyRetained(std::span<uint8_t> to) const {
  size_t at = 0;
  for (uint32_t i = 0; i < program().retain_count && at + program().retains[i].size <= to.size(); ++i) {
    std::memcpy(to.data() + at, loaded_.block.get() + program().retains[i].offset, program().retains[i].size);
    at += program().retains[i].size;
  }
}

bool Instance::restoreRetained(std::span<const uint8_t> from) {
  if (from.size() != loaded_.retained.size()) return false;
  size_t at = 0;
  for (uint32_t i = 0; i < program().retain_count; ++i) {
    std::memcpy(loaded_.block.get() + program().retains[i].offset, from.data() + at, program().retains[i].size);
    at += program().retains[i].size;
  }
  return true;
}

void Instance::clearProfile() { std::fill(loaded_.profile.begin(), loaded_.profile.end(), rung_prof{}); }

// ---- another program ---------------------------------------------------------------------------------------------

namespace {

// The same fault in the tables of another program. Fields that it does not have are unset.
rung_fault translated(const rung_fault& fault, const rung_program& from, const rung_program& to) {
  if (fault.code == RUNG_NONE) return fault;
  const bool isHosts = fault.code == core::kOverrunFault || fault.code == core::kMaxTimeFault;
  rung_fault out = {isHosts ? fault.code : core::kUndescribedFault, RUNG_NONE, fault.line, RUNG_NONE};
  for (uint32_t i = 0; fault.code < from.fault_count && i < to.fault_count; ++i)
    if (std::strcmp(from.faults[fault.code], to.faults[i]) == 0) out.code = i;
  for (uint32_t i = 0; fault.rung < from.rung_count && i < to.rung_count; ++i)
    if (from.rungs[fault.rung].key == to.rungs[i].key) out.rung = i;
  if (fault.task < from.task_count) out.task = findTask(to, from.tasks[fault.task].name);
  return out;
}

} // namespace

bool Instance::servicesAgree(const rung_program& next) const {
  if (port_->services.waiting() == 0) return true;
  const rung_program& now = program();
  if (now.service_count > next.service_count) return false;
  for (uint32_t i = 0; i < now.service_count; ++i)
    if (std::strcmp(now.services[i], next.services[i]) != 0) return false;
  return true;
}

ReplaceResult Instance::replace(Replacement& replacement, OwnContents own) {
  const rung_program& former = program();
  if (&replacement.transfer().from() != &former) return ReplaceResult::OtherProgram;
  if (!faulted()) { // after a fault the next step is a power-on, which needs no waiting
    if (!atListStart()) return ReplaceResult::WithinScan;
    if (!servicesAgree(replacement.next())) return ReplaceResult::RequestsWait;
    if (replacement.transfer().waiting(loaded_.block.get()) != nullptr) return ReplaceResult::MechanismWaits;
  }
  bringInLeftOut(); // the next program may read it
  replacement.exchange(loaded_, own);
  runner_.setProgram(program(), loaded_.block.get(), loaded_.parts.data(), loaded_.engine, loaded_.steps.data());
  ctx_->fault = translated(ctx_->fault, former, program());
  ctx_->prof = loaded_.counters();
  setServices();
  clearProfile();
  ++generation_;
  if (hooks_ != nullptr) hooks_->onReplace(*this);
  if (outside_ != nullptr) outside_->changedWhole(*this);
  return ReplaceResult::Replaced;
}

// ---- state -------------------------------------------------------------------------------------------------------

namespace {

// A state begins with this, its forced bits, and StateRun.
struct StateHead {
  static constexpr uint32_t kVersion = 1;
  uint32_t version = kVersion;
  uint64_t code = 0, layout = 0;
  uint32_t size = 0;
  uint32_t forced = 0; // bits

  bool isOf(const rung_program& program) const {
    return version == kVersion && code == program.code_hash && layout == program.layout_hash &&
           size == program.memory_size;
  }
  template <class Archive>
  void state(Archive& archive) {
    archive(version, code, layout, size, forced);
  }
};

struct StateRun {
  int64_t nowUs = 0;
  bool faulted = false, stopped = false;
  rung_fault fault{};

  template <class Archive>
  void state(Archive& archive) {
    archive(nowUs, faulted, stopped, fault.code, fault.rung, fault.line, fault.task);
  }
};

} // namespace

bool Instance::save(core::Saver& saver, bool waiting) const noexcept {
  if (!atListStart()) return false;
  const rung_program& of = program();
  const std::span<const core::ForcedBits> forced = runner_.forced();
  saver(StateHead{.code = of.code_hash,
                  .layout = of.layout_hash,
                  .size = of.memory_size,
                  .forced = static_cast<uint32_t>(forced.size())});
  for (const core::ForcedBits& bits : forced) saver(bits.offset, bits.mask, bits.value);
  saver(StateRun{.nowUs = ctx_->now_us, .faulted = faulted(), .stopped = stopped(), .fault = ctx_->fault});
  saver.bytes(block());
  for (const core::PartState& part : loaded_.parts) saver(part.pc, part.part, part.budget);
  port_->services.save(saver, waiting);
  return true;
}

// Whether this is a state of the program with the forces of now.
LoadResult Instance::checkState(core::Loader& loader) const noexcept {
  StateHead head;
  loader(head);
  if (!loader.good() || head.version != StateHead::kVersion) return LoadResult::Damaged;
  if (!head.isOf(program())) return LoadResult::OtherProgram;
  const std::span<const core::ForcedBits> forced = runner_.forced();
  bool same = head.forced == forced.size();
  for (uint32_t i = 0; i < head.forced && loader.good(); ++i) {
    core::ForcedBits bits;
    loader(bits.offset, bits.mask, bits.value);
    same = same && bits.offset == forced[i].offset && bits.mask == forced[i].mask && bits.value == forced[i].value;
  }
  if (!loader.good()) return LoadResult::Damaged;
  return same ? LoadResult::Loaded : LoadResult::OtherForces;
}

// Compiled rungs rely on bits that are 0 or 1.
bool Instance::hasOnlyBits() const noexcept {
  bool good = true;
  eachBits(program(), [&](size_t offset, size_t count) noexcept {
    good = good && std::ranges::none_of(block().subspan(offset, count), [](uint8_t bit) { return bit > 1; });
  });
  return good;
}

void Instance::loadState(core::Loader& loader) noexcept {
  StateRun run;
  loader(run);
  ctx_->now_us = run.nowUs;
  ctx_->fault = run.fault;
  loader.bytes(block());
  if (!hasOnlyBits()) loader.fail();
  for (uint32_t task = 0; task < program().task_count; ++task) {
    core::PartState& part = loaded_.parts[task];
    loader(part.pc, part.part, part.budget);
    const bool isChunk = part.pc < program().chunk_count || part.pc == RUNG_PC_DONE;
    if (!isChunk || part.part >= std::max(1u, program().tasks[task].part_count)) loader.fail();
  }
  port_->messages.drop();
  port_->services.load(loader);
  runner_.resume(run.faulted, run.stopped);
}

std::span<const uint8_t> Instance::blockIn(std::span<const uint8_t> state, const rung_program& program) noexcept {
  core::Loader loader(state);
  StateHead head;
  loader(head);
  for (uint32_t i = 0; i < head.forced && loader.good(); ++i) {
    core::ForcedBits bits;
    loader(bits.offset, bits.mask, bits.value);
  }
  StateRun run;
  loader(run);
  if (!loader.good() || !head.isOf(program) || loader.left() < program.memory_size) return {};
  return state.subspan(state.size() - loader.left(), program.memory_size);
}

LoadResult Instance::load(core::Loader& loader) noexcept {
  if (const LoadResult checked = checkState(loader); checked != LoadResult::Loaded) return checked;
  loadState(loader);
  if (!loader.good()) {
    coldStart();
    return LoadResult::Damaged;
  }
  if (outside_ != nullptr) outside_->changedWhole(*this);
  return LoadResult::Loaded;
}

// ---- run ---------------------------------------------------------------------------------------------------------

template <class Run>
inline void Instance::runPart(PartKind kind, uint32_t number, Run run) {
  if (outside_ != nullptr) outside_->begins(*this, kind, number);
  run();
  if (outside_ != nullptr) outside_->ended(*this);
}

void Instance::scan() {
  runPart(PartKind::Scan, RUNG_NONE, [this] {
    port_->services.deliver();
    runner_.scan();
  });
}

void Instance::slot() {
  runPart(PartKind::Slot, RUNG_NONE, [this] {
    port_->services.deliver();
    runner_.slot();
  });
}

void Instance::fast() {
  runPart(PartKind::Fast, RUNG_NONE, [this] {
    port_->services.deliver();
    runner_.fast();
  });
}

void Instance::slice() {
  runPart(PartKind::Slice, RUNG_NONE, [this] {
    port_->services.deliver();
    runner_.slice();
  });
}

void Instance::sliceToFast() {
  runPart(PartKind::SliceToFast, RUNG_NONE, [this] {
    port_->services.deliver();
    runner_.sliceToFast();
  });
}

void Instance::runFor(int64_t us) {
  const int64_t end = nowUs() + us;
  int64_t before = nowUs() - 1;
  while (nowUs() < end && nowUs() > before && !faulted()) { // a schedule that takes no time also ends the loop
    before = nowUs();
    scan();
  }
}

bool Instance::runTask(uint32_t task) {
  bool ran = false;
  runPart(PartKind::Task, task, [&] { ran = runner_.runTask(task); });
  return ran;
}

bool Instance::runTask(std::string_view name) { return runTask(findTask(program(), name)); }

bool Instance::halt(uint32_t fault) {
  if (fault >= program().fault_count && fault != core::kOverrunFault) return false;
  bool halted = false;
  runPart(PartKind::Halt, fault, [&] { halted = runner_.halt(fault); });
  return halted;
}

bool Instance::halt(std::string_view fault) {
  for (uint32_t i = 0; i < program().fault_count; ++i)
    if (fault == program().faults[i]) return halt(i);
  return false;
}

bool Instance::haltOverrun() { return halt(core::kOverrunFault); }

} // namespace rung::runtime
