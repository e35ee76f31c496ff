// Start-up, schedule and retained memory of an instance. After construction nothing here allocates.
#include "rtlib/host/instance.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace rung::host {

namespace {

uint32_t blockBytes(const rung_program& program) { return std::max(program.memory_size, rt::Memory::kLeastBlock); }

// At least a cache line.
uint32_t alignOf(const rung_program& program) { return std::max(program.memory_align, 64u); }

uint32_t retainedBytes(const rung_program& program) {
  uint32_t sum = 0;
  for (uint32_t i = 0; i < program.retain_count; ++i) sum += program.retains[i].size;
  return sum;
}

} // namespace

void Instance::FreeBlock::operator()(uint8_t* block) const { ::operator delete(block, std::align_val_t{align}); }

Instance::Instance(const rung_program& program, ScheduleHooks* hooks)
    : program_(&program), hooks_(hooks),
      block_(static_cast<uint8_t*>(::operator new(blockBytes(program), std::align_val_t{alignOf(program)})),
             FreeBlock{alignOf(program)}),
      ctx_(std::make_unique<rung_ctx>()), port_(std::make_unique<rt::HostPort>()),
      profile_(program.instrumented != 0 ? program.rung_count : 0), parts_(program.task_count),
      retained_(retainedBytes(program)), runner_(program, block_.get(), *ctx_, parts_.data()), overwritten_(program) {
  ctx_->host = &rt::hostApi();
  ctx_->host_data = port_.get();
  ctx_->prof = profile_.empty() ? nullptr : profile_.data();
  setTaskWatch(nullptr);
  port_->services.setResponder({&respondHook, this});
  coldStart();
}

// ---- writing -----------------------------------------------------------------------------------------------------

std::optional<Ref> Instance::write(const Ref& ref, uint64_t value) {
  const std::optional<Ref> copied = overwritten_.source(ref);
  if (!copied) writeRaw(memory(), ref, value);
  return copied;
}

std::optional<Ref> Instance::writeReal(const Ref& ref, double value) {
  const std::optional<Ref> copied = overwritten_.source(ref);
  if (!copied) host::writeReal(memory(), ref, value);
  return copied;
}

std::optional<Ref> Instance::writeText(const Ref& ref, std::string_view text) {
  const std::optional<Ref> copied = overwritten_.source(ref);
  if (!copied) host::writeText(memory(), ref, text);
  return copied;
}

// ---- hooks -------------------------------------------------------------------------------------------------------

void Instance::stepHook(void* self, uint32_t work) {
  auto& instance = *static_cast<Instance*>(self);
  if (instance.hooks_ != nullptr) instance.hooks_->onHook(instance, work);
}

void Instance::faultHook(void* self) {
  auto& instance = *static_cast<Instance*>(self);
  if (instance.hooks_ != nullptr) instance.hooks_->onFault(instance);
}

void Instance::taskHook(void* self, uint32_t task, bool begins) {
  const auto& instance = *static_cast<const Instance*>(self);
  if (begins)
    instance.taskWatch_->begins(instance, task);
  else
    instance.taskWatch_->ended(instance, task);
}

void Instance::setTaskWatch(TaskWatch* watch) {
  taskWatch_ = watch;
  runner_.setHooks({&stepHook, &faultHook, this, watch == nullptr ? nullptr : &taskHook});
}

bool Instance::respondHook(void* self, const rt::ServiceRequest& request, rt::ServiceReply& reply) {
  auto& instance = *static_cast<Instance*>(self);
  return instance.hooks_ != nullptr && instance.hooks_->respond(instance, request, reply);
}

// ---- start -------------------------------------------------------------------------------------------------------

void Instance::resetMemory() {
  std::memset(block_.get(), 0, program_->memory_size);
  for (uint32_t i = 0; i < program_->init_count; ++i)
    std::memcpy(block_.get() + program_->inits[i].offset, program_->inits[i].data, program_->inits[i].size);
}

void Instance::resetRun() {
  runner_.reset();
  port_->messages.drop();
  port_->services.restart();
}

void Instance::coldStart() {
  resetMemory();
  resetRun();
}

void Instance::warmStart() {
  copyRetained(retained_);
  resetMemory();
  resetRun();
  restoreRetained(retained_);
}

void Instance::copyRetained(std::span<uint8_t> to) const {
  size_t at = 0;
  for (uint32_t i = 0; i < program_->retain_count && at + program_->retains[i].size <= to.size(); ++i) {
    std::memcpy(to.data() + at, block_.get() + program_->retains[i].offset, program_->retains[i].size);
    at += program_->retains[i].size;
  }
}

bool Instance::restoreRetained(std::span<const uint8_t> from) {
  if (from.size() != retained_.size()) return false;
  size_t at = 0;
  for (uint32_t i = 0; i < program_->retain_count; ++i) {
    std::memcpy(block_.get() + program_->retains[i].offset, from.data() + at, program_->retains[i].size);
    at += program_->retains[i].size;
  }
  return true;
}

void Instance::clearProfile() { std::fill(profile_.begin(), profile_.end(), rung_prof{}); }

// ---- run ---------------------------------------------------------------------------------------------------------

void Instance::scan() {
  port_->services.deliver();
  runner_.scan();
}

void Instance::slot() {
  port_->services.deliver();
  runner_.slot();
}

void Instance::fast() {
  port_->services.deliver();
  runner_.fast();
}

void Instance::slice() {
  port_->services.deliver();
  runner_.slice();
}

void Instance::runFor(int64_t us) {
  const int64_t end = nowUs() + us;
  int64_t before = nowUs() - 1;
  while (nowUs() < end && nowUs() > before && !faulted()) { // a schedule that takes no time ends it too
    before = nowUs();
    scan();
  }
}

bool Instance::runTask(uint32_t task) { return runner_.runTask(task); }

bool Instance::runTask(std::string_view name) { return runner_.runTask(findTask(*program_, name)); }

bool Instance::halt(std::string_view fault) {
  for (uint32_t i = 0; i < program_->fault_count; ++i)
    if (fault == program_->faults[i]) return runner_.halt(i);
  return false;
}

} // namespace rung::host
