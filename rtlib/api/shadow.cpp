// A program that runs beside an instance before it takes over: prepared, begun, worked off, reported.
#include "rtlib/api/shadow.h"

#include <bit>
#include <string>
#include <vector>

#include "rtlib/api/cells.h"
#include "rtlib/api/error.h"
#include "rtlib/api/replacing.h"
#include "rtlib/api/structs.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"

using namespace rung;
using namespace rung::api;

struct rung_shadow {
  rung_shadow(rung_instance& of, std::shared_ptr<const Image> next, uint32_t passes, uint32_t room)
      : instance(of), live(of.generations.running()), image(std::move(next)),
        shadow(live->program(), {image->program, image->engine}, &nc::describe, passes, room) {}

  uint32_t mark = kShadowMark;
  rung_instance& instance;
  std::shared_ptr<Generation> live;
  std::shared_ptr<const Image> image;
  runtime::Shadow shadow;
  // Of the last report.
  std::vector<runtime::ShadowDifference> differences;
  std::string fault;
};

namespace rung::api {

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

int32_t rung_shadow_new(rung_instance* instance, rung_image* image, uint32_t passes, uint32_t room,
                        rung_shadow** shadow) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  const rung_image* next = checked(image, kImageMark);
  if (next == nullptr) return failHandle("an image");
  if (shadow == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the shadow is null");
  if (passes == 0 || passes > RUNG_MOST_SHADOW_PASSES || room == 0 || room > RUNG_MOST_SHADOW_ROOM)
    return fail(RUNG_BAD_ARGUMENT, "a shadow runs for 1 to %u scans and has room for 1 to %u runs, not for %u and %u",
                RUNG_MOST_SHADOW_PASSES, RUNG_MOST_SHADOW_ROOM, passes, room);
  if (const int32_t status = checkDialect(*handle, next->image->program); status != RUNG_OK) return status;
  if (const int32_t status = handle->structs.check(next->image->program); status != RUNG_OK) return status;
  return contained([&] {
    auto made = std::make_unique<rung_shadow>(*handle, next->image, passes, room);
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
  instance.generations.letGo();
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
