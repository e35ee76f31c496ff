// Another program for an instance: prepared outside real time, activated between two scans.
#include "rtlib/api/replacing.h"

#include <atomic>
#include <bit>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "rtlib/api/cells.h"
#include "rtlib/api/error.h"
#include "rtlib/api/running.h"
#include "rtlib/change/replacement.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/scan_bound.h"

using namespace rung;
using namespace rung::api;

struct rung_replacement {
  rung_replacement(rung_instance& of, const std::shared_ptr<const Image>& image, uint8_t* memory)
      : instance(of), former(of.generations.running()),
        replacement(former->program(), {image->program, image->engine, memory, of.serviceNames.of(image->program)},
                    nc::naming(image->program)),
        places(of.control->locate(image->program)), environmentPlaces(of.environment->locate(image->program)),
        channel(std::make_unique<runtime::RetainChannel>(runtime::RetainMap(image->program))) {
    bound = runtime::measureBound({image->program, image->engine});
    boundText = runtime::boundText(bound, image->program);
    next = of.generations.add(*of.environment, image, replacement.copyLists());
    if (of.recording) {
      recorded = of.recording->prepare(*next);
      of.recording->addProgram(*image);
    }
  }
  ~rung_replacement() {
    rung_replacement* self = this;
    instance.former.compare_exchange_strong(self, nullptr);
    instance.puttingBack.wait();
    const std::lock_guard lock(instance.retentionChanges);
    if (instance.retention) instance.retention->settle();
  }

  const rung_program& program(bool theFormer) const noexcept { return (theFormer ? former : next)->program(); }
  // The generation that the replacement holds: of its two programs, the one that is not running.
  Generation& held() const noexcept { return holdsFormer ? *former : *next; }

  uint32_t mark = kReplacementMark;
  rung_instance& instance;
  std::shared_ptr<Generation> former, next;
  runtime::Replacement replacement;
  // For the program that it holds:
  std::unique_ptr<nc::Places> places;              // of the control
  std::unique_ptr<nc::Places> environmentPlaces;   // of the environment
  std::unique_ptr<runtime::RetainChannel> channel; // for retained memory
  InstanceRecording::Next recorded;                // empty: the recording began later
  std::atomic<bool> holdsFormer{false};            // `next` is running
  std::atomic<bool> spent{false};                  // a fault of `next` has put `former` back
  runtime::ScanBound bound;                        // of `next`
  std::string boundText;
  std::atomic<bool> mayBeLate{false};
};

using namespace rung;
using namespace rung::api;

struct rung_shadow {
  rung_shadow(rung_instance& of, std::shared_ptr<const Image> next, uint32_t scans, uint32_t room)
      : instance(of), live(of.generations.running()), image(std::move(next)),
        shadow(live->program(), {image->program, image->engine}, &nc::describe, scans, room,
               nc::naming(image->program)) {}

  uint32_t mark = kShadowMark;
  rung_instance& instance;
  std::shared_ptr<Generation> live;
  std::shared_ptr<const Image> image;
  runtime::Shadow shadow;
  // Results of the last report:
  std::vector<runtime::ShadowDifference> differences;
  std::string fault;
};

namespace rung::api {

namespace {

rung_rung_change rungChangeOf(const rung_replacement& replacement, const runtime::RungChange& change) noexcept {
  const bool removed = change.after == RUNG_NONE;
  const rung_program& program = replacement.program(removed != replacement.holdsFormer);
  const rung_info& rung = program.rungs[removed ? change.before : change.after];
  return {.kind = runtime::changeKind(change),
          .rung = rung.number,
          .line = rung.first_line,
          .file = rung.file < program.file_count ? program.files[rung.file] : "",
          .title = rung.title};
}

int32_t failOther() noexcept { return fail(RUNG_BAD_ARGUMENT, "the replacement was made for another instance"); }

// Keeps the fault of the program that ran, and its generation.
void keepFault(rung_instance& instance, Generation& ran, const rung_fault& fault) noexcept {
  if (!instance.running.faulted() || instance.faulted != nullptr) return;
  instance.fault = fault;
  ran.refer();
  instance.faulted = &ran;
}

runtime::ReplaceResult exchange(rung_instance& instance, rung_replacement& replacement,
                                runtime::OwnContents own) noexcept {
  const rung_fault fault = instance.running.fault();
  const runtime::ReplaceResult result = instance.running.replace(replacement.replacement, own);
  if (result != runtime::ReplaceResult::Replaced) return result;
  keepFault(instance, instance.now(), fault);
  instance.control->exchangePlaces(instance.running, replacement.places);
  instance.environment->exchangePlaces(replacement.environmentPlaces);
  instance.environment->programChanged(instance.running, instance.now().program());
  instance.generations.enter(replacement.held());
  instance.beginLeavingOut();
  settleForces(instance);
  if (instance.retention) instance.retention->programChanged(replacement.channel);
  if (instance.recording) instance.recording->programChanged(replacement.recorded);
  instance.pace.programChanged();
  replacement.holdsFormer = !replacement.holdsFormer;
  instance.former.store(replacement.holdsFormer ? &replacement : nullptr);
  return result;
}

} // namespace

int32_t nextOf(const rung_instance& instance, const rung_replacement* replacement, std::shared_ptr<Generation>& next) {
  const rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  if (&handle->instance != &instance) return failOther();
  next = handle->holdsFormer ? handle->former : handle->next;
  return RUNG_OK;
}

int32_t failLater(const rung_instance& instance, runtime::ReplaceResult result,
                  const runtime::StateTransfer& transfer) noexcept {
  if (result == runtime::ReplaceResult::WithinScan) return fail(RUNG_LATER, "the program is within a scan");
  if (result == runtime::ReplaceResult::RequestsWait)
    return fail(RUNG_LATER, "a request waits for its answer, and the new program numbers its services otherwise");
  return fail(RUNG_LATER, "%s waits at an instruction that the new program does not have",
              transfer.waiting(instance.running.block().data()));
}

int32_t checkDialect(const rung_instance& instance, const rung_program& program) noexcept {
  if (instance.dialect == program.dialect) return RUNG_OK;
  return fail(RUNG_REFUSED, "%s has the dialect %s, but the running program has %s", program.name, program.dialect,
              instance.dialect.c_str());
}

void putFormerBack(rung_instance& instance) noexcept {
  instance.puttingBack.enter();
  if (rung_replacement* replacement = instance.former.exchange(nullptr); replacement != nullptr) {
    if (exchange(instance, *replacement, runtime::OwnContents::AsLeft) == runtime::ReplaceResult::Replaced)
      replacement->spent = true;
  }
  instance.puttingBack.leave();
}

// Shadows: a program that runs beside an instance before it takes over.

void shadowRequest(rung_instance& instance, const core::ServiceRequest& request) noexcept {
  if (rung_shadow* shadow = instance.shadow.load(std::memory_order_relaxed)) shadow->shadow.requested(request);
}

void endShadow(rung_instance& instance) noexcept {
  rung_shadow* shadow = instance.shadow.load(std::memory_order_relaxed);
  if (shadow == nullptr) return;
  shadow->shadow.end(instance.running);
  instance.shadow.store(nullptr, std::memory_order_release); // another thread may free it now
}

namespace {

rung_value valueOf(const runtime::Ref& ref, uint64_t bits) noexcept {
  rung_value value{};
  const uint32_t unused = 64u - ref.width;
  if (ref.kind == runtime::RefKind::Real)
    value.real = std::bit_cast<double>(bits);
  else if (ref.kind == runtime::RefKind::Bit)
    value.integer = static_cast<int64_t>(bits);
  else
    value.integer = static_cast<int64_t>(bits << unused) >> unused;
  return value;
}

constexpr uint32_t kStates[] = {RUNG_SHADOW_PREPARED, RUNG_SHADOW_RUNNING, RUNG_SHADOW_FINISHED,
                                RUNG_SHADOW_TOO_SLOW, RUNG_SHADOW_STOPPED, RUNG_SHADOW_FAULTED}; // by ShadowState

} // namespace

} // namespace rung::api

int32_t rung_replacement_new(rung_instance* instance, rung_image* image, void* memory, size_t memory_bytes,
                             rung_replacement** replacement) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  const rung_image* next = checked(image, kImageMark);
  if (next == nullptr) return failHandle("an image");
  if (replacement == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the replacement is null");
  const rung_program& program = next->image->program;
  if (const int32_t status = checkDialect(*handle, program); status != RUNG_OK) return status;
  if (const int32_t status = checkMemory(program, memory, memory_bytes); status != RUNG_OK) return status;
  if (const int32_t status = handle->structs.check(program); status != RUNG_OK) return status;
  return contained([&] {
    *replacement = new rung_replacement(*handle, next->image, static_cast<uint8_t*>(memory));
    return int32_t{RUNG_OK};
  });
}

int32_t rung_replacement_free(rung_replacement* replacement) {
  if (replacement == nullptr) return RUNG_OK;
  rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  rung_instance& instance = handle->instance;
  release(handle);
  instance.generations.release();
  return RUNG_OK;
}

int32_t rung_replacement_report(const rung_replacement* replacement, rung_replacement_info* info) {
  const rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  const runtime::StateTransfer& transfer = handle->replacement.transfer();
  return giveStruct(info, rung_replacement_info{.kept_cells = transfer.keptCells(),
                                                .kept_states = transfer.keptSlots(),
                                                .changes = static_cast<uint32_t>(transfer.changes().size()),
                                                .bytes = handle->replacement.bytes(),
                                                .steps = handle->bound.weight,
                                                .slice_ns = static_cast<uint64_t>(handle->bound.ns),
                                                .period_ns = static_cast<uint64_t>(handle->bound.periodNs),
                                                .bound = handle->boundText.c_str(),
                                                .program = handle->next->number,
                                                .next = handle->spent ? 0 : handle->held().number});
}

int32_t rung_replacement_allow_late(rung_replacement* replacement) {
  rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  handle->mayBeLate = true;
  return RUNG_OK;
}

int32_t rung_replacement_change(const rung_replacement* replacement, uint32_t index, rung_change* change) {
  const rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  const std::span<const runtime::StateChange> changes = handle->replacement.transfer().changes();
  if (index >= changes.size()) return RUNG_EMPTY;
  const runtime::StateChange& c = changes[index];
  return giveStruct(change, rung_change{.kind = static_cast<uint32_t>(c.kind),
                                        .is_state = c.slot ? 1u : 0u,
                                        .name = c.name.c_str(),
                                        .former = c.formerName.c_str()});
}

int32_t rung_replacement_rung(const rung_replacement* replacement, uint32_t index, rung_rung_change* change) {
  const rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  const std::span<const runtime::RungChange> changes = handle->replacement.transfer().rungs();
  if (index >= changes.size()) return RUNG_EMPTY;
  return giveStruct(change, rungChangeOf(*handle, changes[index]));
}

int32_t rung_instance_replace(rung_instance* instance, rung_replacement* replacement) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  if (&handle->instance != &*call) return failOther();
  if (handle->spent)
    return fail(RUNG_WRONG_STATE, "a fault of the program %s has put the former program back already",
                handle->next->program().name);
  if (!handle->holdsFormer && !handle->bound.fits() && !handle->mayBeLate)
    return fail(RUNG_REFUSED, "a slice of the new program may last %s", handle->boundText.c_str());
  const runtime::ReplaceResult result = exchange(*call, *handle, runtime::OwnContents::Initial);
  if (result == runtime::ReplaceResult::Replaced) return RUNG_OK;
  if (result == runtime::ReplaceResult::OtherProgram)
    return fail(RUNG_WRONG_STATE, "the replacement was made for another program than the one that runs");
  return failLater(*call, result, handle->replacement.transfer());
}

int32_t rung_shadow_new(rung_instance* instance, rung_image* image, uint32_t scans, uint32_t room,
                        rung_shadow** shadow) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  const rung_image* next = checked(image, kImageMark);
  if (next == nullptr) return failHandle("an image");
  if (shadow == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the shadow is null");
  if (scans == 0 || scans > RUNG_MOST_SHADOW_SCANS || room == 0 || room > RUNG_MOST_SHADOW_ROOM)
    return fail(RUNG_BAD_ARGUMENT, "a shadow runs for 1 to %u scans and has room for 1 to %u runs, not for %u and %u",
                RUNG_MOST_SHADOW_SCANS, RUNG_MOST_SHADOW_ROOM, scans, room);
  if (const int32_t status = checkDialect(*handle, next->image->program); status != RUNG_OK) return status;
  if (const int32_t status = handle->structs.check(next->image->program); status != RUNG_OK) return status;
  return contained([&] {
    auto made = std::make_unique<rung_shadow>(*handle, next->image, scans, room);
    if (!made->shadow.problem().empty())
      return fail(RUNG_REFUSED, "the programs cannot run side by side: %s", made->shadow.problem().c_str());
    *shadow = made.release();
    return int32_t{RUNG_OK};
  });
}

int32_t rung_shadow_free(rung_shadow* shadow) {
  if (shadow == nullptr) return RUNG_OK;
  rung_shadow* handle = checked(shadow, kShadowMark);
  if (handle == nullptr) return failHandle("a shadow");
  rung_instance& instance = handle->instance;
  if (instance.shadow.load(std::memory_order_acquire) == handle) {
    const Call call(&instance);
    if (!call.ok()) return call.status();
    endShadow(*call);
  }
  release(handle);
  instance.generations.release();
  return RUNG_OK;
}

int32_t rung_instance_shadow(rung_instance* instance, rung_shadow* shadow) {
  const Call call(instance, shadow != nullptr ? When::On : When::Outside);
  if (!call.ok()) return call.status();
  if (shadow == nullptr) {
    endShadow(*call);
    return RUNG_OK;
  }
  rung_shadow* handle = checked(shadow, kShadowMark);
  if (handle == nullptr) return failHandle("a shadow");
  if (&handle->instance != &*call) return fail(RUNG_BAD_ARGUMENT, "the shadow was made for another instance");
  if (call->running.faulted()) return RUNG_FAULTED;
  if (call->shadow != nullptr) return fail(RUNG_WRONG_STATE, "the instance has a shadow: end that first");
  const runtime::ReplaceResult result = handle->shadow.begin(call->running);
  if (result == runtime::ReplaceResult::OtherProgram)
    return fail(RUNG_WRONG_STATE,
                "the shadow has begun before, or was made for another program than the one that runs");
  if (result != runtime::ReplaceResult::Replaced) return failLater(*call, result, handle->shadow.transfer());
  call->shadow = handle;
  return RUNG_OK;
}

int32_t rung_shadow_work(rung_shadow* shadow) {
  rung_shadow* handle = checked(shadow, kShadowMark);
  if (handle == nullptr) return failHandle("a shadow");
  return contained([&] { return int32_t{handle->shadow.work() ? RUNG_OK : RUNG_EMPTY}; });
}

int32_t rung_shadow_report(rung_shadow* shadow, rung_shadow_info* info) {
  rung_shadow* handle = checked(shadow, kShadowMark);
  if (handle == nullptr) return failHandle("a shadow");
  return contained([&] {
    handle->differences = handle->shadow.differences();
    handle->fault = handle->shadow.faultText();
    return giveStruct(info, rung_shadow_info{.state = kStates[static_cast<size_t>(handle->shadow.state())],
                                             .differences = static_cast<uint32_t>(handle->differences.size()),
                                             .runs = handle->shadow.runs(),
                                             .fault = handle->fault.c_str()});
  });
}

int32_t rung_shadow_difference(const rung_shadow* shadow, uint32_t index, rung_difference* difference) {
  const rung_shadow* handle = checked(shadow, kShadowMark);
  if (handle == nullptr) return failHandle("a shadow");
  if (index >= handle->differences.size()) return RUNG_EMPTY;
  const runtime::ShadowDifference& d = handle->differences[index];
  return giveStruct(difference, rung_difference{.type = d.service ? 0u : uint32_t{typeOf(d.ref)},
                                                .name = d.name.c_str(),
                                                .first_us = d.firstUs,
                                                .runs = d.runs,
                                                .running = valueOf(d.ref, d.live),
                                                .next = valueOf(d.ref, d.next)});
}
